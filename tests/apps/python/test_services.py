import subprocess
import threading
import time

import pytest

import runnel


class Mapper(runnel.Module):
    """What is asked is served in its cycles."""
    period = 0.01

    def __init__(self):
        self.count = 0

    @runnel.service
    def save(self, file: str = "map.pgm", scale: float = 1.0) -> "Pose2":
        """Saves the map."""
        if file == "nowhere":
            raise FileNotFoundError("no such folder")
        self.count += 1
        return {"x": scale, "y": self.count}

    @runnel.service
    def move(self, by: "Point2", names: "double[]"):
        self.count += by.x + len(names)

    @runnel.service
    def wrong(self) -> "Pose2":
        return "no pose"

    @runnel.service(activity=True, description="takes long")
    def explore(self, activity, rooms: int) -> int:
        for i in range(rooms):
            activity.report(i / rooms, "looking")
        while rooms == 0 and not activity.is_abort_asked:
            pass
        return rooms

    def update(self):
        pass


class Asker(runnel.Module):
    period = 0.01
    save = runnel.Client("Pose2", {"file": str, "scale": float}, timeout=1)
    move = runnel.Client(None, ["Point2", "double[]"])
    explore = runnel.Client(int, int, timeout=1e6)  # s of simulated time, which passes while its thread is at work
    nobody = runnel.Client()
    said = runnel.Output("string")

    def __init__(self):
        self.answers = []
        self.asked = None

    def answered(self, call):
        self.answers.append(call.error or call.reply.x)
        self.said.publish(" | ".join(map(str, self.answers)))

    def update(self):
        if self.asked is None:
            assert self.save.is_connected and not self.nobody.is_connected
            assert self.save.call(self.answered, "a.pgm", scale=3)
            assert self.save.call(self.answered, file="nowhere", scale=0)
            assert self.move.send({"x": 10, "y": 0}, [1, 2])
            assert not self.nobody.send() and not self.nobody.call(self.answered)
            none = self.nobody.begin()
            assert none.is_done and none.status == "not_connected" and none.reply is None
            self.asked = self.explore.begin(5)
            assert not self.asked.is_done
        if self.asked.is_done and len(self.answers) == 2:
            self.answers.append(self.asked.reply)
            self.said.publish(" | ".join(map(str, self.answers)))


class Collector(runnel.Module):
    """Keeps what callbacks got, though there is one slot for all of its calls."""
    period = 0.01
    save = runnel.Client("Pose2", {"file": str, "scale": float}, calls=1, timeout=1)
    said = runnel.Output("string")

    def __init__(self):
        self.kept = []

    def update(self):
        self.save.call(self.kept.append, "nowhere" if len(self.kept) == 1 else "a.pgm", scale=len(self.kept))
        self.said.publish(" ".join(each.error[:4] or str(each.reply.x) for each in self.kept))


@pytest.fixture
def app():
    with runnel.compose("house", clock="simulated") as app:
        app.create("mapper", Mapper)
        app.create("asker", Asker)
        for each in ("save", "move", "explore"):
            app.connect(f"/mapper/{each}", f"/asker/{each}")
        yield app


def test_modules_call_each_other(app):
    end = time.monotonic() + 60
    while (app.read("/asker/said") or "").count("|") < 2 and time.monotonic() < end:
        app.run_for(0.01)
    said = app.read("/asker/said")
    assert said.startswith("3.0 | FileNotFoundError: no such folder;") and said.endswith("| 5")
    assert not app.faults()
    assert any("Traceback" in each.text and "no such folder" in each.text for each in app.log() if each.kind == "error")
    assert app.call("/mapper/save").y == 1 + 10 + 2 + 1


def test_what_is_kept_of_a_call_is_that_call(app):
    app.create("collector", Collector)
    app.connect("/mapper/save", "/collector/save")
    app.run_for(0.3)
    assert app.read("/collector/said").startswith("0.0 File 2.0 3.0 4.0")
    assert not app.faults()


def test_who_is_outside_calls_them(app):
    assert ("/house/mapper/output/save", "service", "service Pose2(string, double)") in app.paths("service")
    assert app.call("/mapper/save") == runnel.types.Pose2(x=1, y=1)
    assert app.call("/mapper/save", file="x", scale=4).x == 4
    with pytest.raises(TypeError, match="or arguments by their names"):
        app.call("/mapper/save", {"file": "x"}, scale=4)  # of which one was left out without a word
    with pytest.raises(runnel.Error, match="has no 'scael'"):
        app.call("/mapper/save", scael=4)
    assert app.call("/mapper/explore", rooms=3, timeout=1e6) == 3
    with pytest.raises(runnel.Error, match="FileNotFoundError"):
        app.call("/mapper/save", file="nowhere")
    with pytest.raises(runnel.Error, match="what it has returned is no Pose2"):
        app.call("/mapper/wrong")
    with pytest.raises(TypeError, match="the service wants"):
        app.call("/mapper/explore")


def test_who_is_outside_says_what_has_no_default(xml):
    with runnel.load(xml / "apps/genom_demo.xml", speed=0) as app:
        with pytest.raises(TypeError, match="the service wants 'id', too"):
            app.call("/guide/abort_activity", {})
        with pytest.raises(runnel.Error, match="argument 'id' is not given"):
            app.call("/guide/abort_activity", "{}")
        app.run_for(0.1)
        with pytest.raises(runnel.Error, match="'turn_rate' is not given"):
            app.set("/guide/set_limits", {"speed": 0.3})
        app.start()
        with pytest.raises(runnel.Error, match="refuses the value: guide::too_far"):
            app.set("/guide/set_limits", {"speed": 3, "turn_rate": 1})
        app.set("/guide/set_limits", {"speed": 0.3, "turn_rate": 1})


def test_who_sets_an_attribute_while_another_call_runs_hears_of_its_refusal(xml):
    with runnel.load(xml / "apps/genom_demo.xml", speed=1) as app:
        runs = threading.Thread(target=app.run)
        runs.start()
        while app.time == 0:
            time.sleep(0.001)
        with pytest.raises(runnel.Error, match="refuses the value: guide::too_far"):
            app.set("/guide/set_limits", {"speed": 3, "turn_rate": 1})
        app.quit()
        runs.join()


def test_connections_are_checked_by_type(app):
    with pytest.raises(runnel.Error, match="takes service void"):
        app.connect("/mapper/save", "/asker/nobody")




SERVER = """
import runnel

class Doubler(runnel.Module):
    calls = 0

    @runnel.service
    def count(self) -> int:
        return self.calls

    @runnel.service
    def double(self, value: float = 21) -> float:
        "Doubles."
        if value < 0:
            raise ValueError("is negative")
        self.calls += 1
        return 2 * value

    def update(self):
        pass
"""

HOUSE = """<application name="house" thread="main">
  <load plugin="python"/> <thread name="main" period="10ms"/>
  <module name="doubler" type="python/doubler.Doubler"/>
</application>
"""


def wait_until(is_so):
    end = time.monotonic() + 60
    while not is_so():
        assert time.monotonic() < end
        time.sleep(0.05)


def connected(name):
    end = time.monotonic() + 60
    while True:
        try:
            return runnel.connect(name, timeout=60)
        except runnel.Error:
            if time.monotonic() > end:
                raise
            time.sleep(0.05)


def test_the_program_calls_them(empty_folder, program):
    (empty_folder / "doubler.py").write_text(SERVER)
    (empty_folder / "house.xml").write_text(HOUSE)
    running = subprocess.Popen([program, "run", "house.xml", "--quiet"])

    def call(*words):
        return subprocess.run([program, "call", *words], capture_output=True, text=True, timeout=60)

    try:
        with connected("house") as house:
            assert house.call("/doubler/double") == "42"
            assert house.call("/doubler/double", value=4) == "8"
            with pytest.raises(TypeError, match="or arguments by their names"):
                house.call("/doubler/double", {"value": 3}, value=4)
            assert call("/doubler/double").stdout == "42\n"
            assert call("/doubler/double", "{value: 3}").stdout == "6\n"
            failed = call("/doubler/double", "{value: -1}")
            assert failed.returncode != 0 and "ValueError: is negative; doubler.py:15, in double" in failed.stderr
            wait_until(lambda: any("Traceback" in each for each in house.log()))
            (empty_folder / "doubler.py").write_text(SERVER.replace("2 * value", "3 * value"))
            house.reload("python")
            assert house.call("/doubler/double") == "63"
            assert house.call("/doubler/count") == "5", "what it remembers is kept"
            house.quit()
        assert running.wait(60) == 0
    finally:
        running.kill()
        running.wait()


class Fuse(runnel.Module):
    """Its ports depend on static parameters."""
    inputs = runnel.StaticParameter(1, bounds=(1, 8))
    carries = runnel.StaticParameter("double")

    def make_ports(self):
        ports = {f"in{i}": runnel.Input(self.carries) for i in range(self.inputs)}
        return ports | {"sum": runnel.Output(self.carries)}

    def __init__(self):
        self.read = [getattr(self, f"in{i}") for i in range(self.inputs)]

    def update(self):
        self.sum.publish(sum(each.read() or 0 for each in self.read))


class Source(runnel.Module):
    out = runnel.Output("double")

    def update(self):
        self.out.publish(2.0)


def test_ports_by_static_parameters():
    with runnel.compose("fusion", clock="simulated") as app:
        app.create("source", Source)
        app.create("fuse", Fuse, inputs=3)
        app.connect("/source/out", "/fuse/in0", "/fuse/in2")
        app.run_for(0.2)
        assert app.read("/fuse/sum") == 4
        assert [path for path, _, _ in app.paths("input")] == [f"/fusion/fuse/input/in{i}" for i in range(3)]
        app.set("/fuse/inputs", 5)  # makes it anew
        app.run_for(0.2)
        assert app.read("/fuse/sum") == 4 and len(app.paths("input")) == 5
        app.swap("/fuse", Fuse, inputs=4)
        app.run_for(0.2)
        assert app.read("/fuse/sum") == 4 and len(app.paths("input")) == 4
        app.create("texts", Fuse, carries="Pose2")
        assert ("/fusion/texts/input/in0", "input", "Pose2") in app.paths("input")
        with pytest.raises(runnel.Error, match="9"):
            app.create("many", Fuse, inputs=9)


class Wrong(runnel.Module):
    def make_ports(self):
        return {"update": runnel.Input("double")}


class AlsoWrong(runnel.Module):
    client = runnel.Client("NoSuchType")


def test_mistakes_in_classes_are_told():
    with pytest.raises(TypeError, match="does not say of which type 'x' is"):
        @runnel.service
        def f(self, x):
            pass

    with runnel.compose("wrong", clock="simulated") as app:
        with pytest.raises(runnel.Error, match="make_ports.. has 'update', which the class has, too"):
            app.create("wrong", Wrong)
        with pytest.raises(runnel.Error, match="there is no type 'NoSuchType'"):
            app.create("also_wrong", AlsoWrong)
