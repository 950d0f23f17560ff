import gc
import subprocess
import sys
import time

import pytest

import runnel

FOLLOWER = '''
import runnel


class Follower(runnel.Module):
    scan = runnel.Input("RangeScan", required=True)
    twist = runnel.Output("Twist2")
    distance = runnel.Parameter(0.6, unit="m", bounds=(0.2, 3.0))
    count = 0

    def update(self):
        scan = self.scan.new()
        if scan is None:
            return
        self.count += 1
        near = scan.ranges.min() < self.distance
        self.twist.publish(forward=0.0 if near else 0.4, turn=1.0 if near else 0.0)
'''

WANDER = '''<application name="wander">
  <load plugin="simulation"/> <load plugin="motion"/> <load plugin="python"/>
  <clock type="simulated" speed="0"/> <thread name="control" period="50ms"/>
  <module name="world" type="simulation/world"> <parameter name="world" value="rooms"/> </module>
  <module name="laser" type="simulation/laser"/>
  <module name="wanderer" type="python/follower.Follower"> <parameter name="distance" value="0.7"/> </module>
  <module name="drive" type="motion/differential_drive"/>
  <connect from="world/scene" to="laser/scene"/>
  <connect from="world/pose" to="laser/pose"/>
  <connect from="laser/scan" to="wanderer/scan"/>
  <connect from="wanderer/twist" to="drive/twist"/>
  <connect from="drive/wheels" to="world/wheels"/>
</application>
'''


@pytest.fixture
def files(empty_folder):
    (empty_folder / "robot").mkdir()
    (empty_folder / "robot/follower.py").write_text(FOLLOWER)
    (empty_folder / "robot/wander.xml").write_text(WANDER)
    return empty_folder / "robot"


@pytest.fixture
def app(files):
    with runnel.load(files / "wander.xml") as app:
        yield app


def rewritten(files, old, new):
    text = FOLLOWER.replace(old, new)
    assert text != FOLLOWER
    (files / "follower.py").write_text(text)


def test_drives_the_robot(app):
    start = app.read("/world/pose")
    app.run_for(10)
    assert app.read("/world/pose") != start
    assert app["/wanderer/distance"] == 0.7


def test_has_a_thread_of_its_own_that_no_file_needs_to_name(app, files):
    app.run_for(1)
    app.save(files / "wander.xml")
    assert (files / "wander.xml").read_text() == WANDER
    app.swap("/wanderer", "python/follower.Follower")
    app.run_for(1)
    app.swap("/wanderer", "python/follower.Follower")
    app.undo()
    app.undo()
    app.save(files / "wander.xml")
    assert (files / "wander.xml").read_text() == WANDER
    app.apply("schedule /threads/python_wanderer period=20ms")
    app.save(files / "wander.xml")
    text = (files / "wander.xml").read_text()
    assert 'thread="python_wanderer"' in text and '<thread name="python_wanderer" period="20ms"/>' in text
    with runnel.load(files / "wander.xml") as again:
        again.run_for(1)


def test_is_made_anew_from_its_file_and_remembers(app, files):
    app.run_for(1)
    rewritten(files, "self.count += 1", "self.count += 1000\n        self.log(str(self.count))")
    app.reload()
    app.run_for(0.1)
    said = [each.text for each in app.log() if each.kind == "info"]
    assert any(1000 < int(each.split(": ")[1]) < 1100 for each in said)


def test_one_that_throws_is_taken_out_again(app, files):
    app.run_for(1)
    rewritten(files, "self.count += 1", "raise ValueError('new and wrong')")
    app.swap("/wanderer", "python/follower.Follower")
    app.run_for(1)
    assert "is back in its place" in app.faults()[-1].text
    app.run_for(1)
    assert len(app.faults()) == 1


def test_an_exception_is_a_fault_with_its_traceback(files):
    rewritten(files, "self.count += 1", "self.help()")
    with open(files / "follower.py", "a") as file:
        file.write("\n    def help(self):\n        return 1 // 0\n")
    with runnel.load(files / "wander.xml") as app:
        app.run_for(1)
        app.events()
        fault = app.faults()[0].text
        assert "ZeroDivisionError" in fault and "in help: return 1 // 0" in fault and "in update: self.help()" in fault
        assert any("Traceback" in each.text for each in app.log() if each.kind == "error")


@pytest.mark.parametrize("thrown, told", [
    ("type('Mute', (Exception,), {'__str__': lambda self: 1 // 0})()", "Mute: <its __str__ throws, too>"),
    (r"ValueError('half \ud800')", r"ValueError: half \ud800"),
])
def test_what_is_thrown_is_told_whatever_it_says_of_itself(files, thrown, told):
    rewritten(files, "self.count += 1", f"raise {thrown}")
    with runnel.load(files / "wander.xml") as app:
        app.run_for(1)
        app.events()
        assert told in app.faults()[0].text


def test_mistakes_are_told_with_their_places(files):
    rewritten(files, "self.count += 1", "self.count += (1")
    with pytest.raises(runnel.Error, match="SyntaxError") as wrong:
        runnel.load(files / "wander.xml")
    assert wrong.value.file.endswith("follower.py") and wrong.value.line == 15
    (files / "wander.xml").write_text(WANDER.replace("follower.Follower", "follower.Folower"))
    (files / "follower.py").write_text(FOLLOWER)
    with pytest.raises(runnel.Error, match="did you mean 'Follower'") as wrong:
        runnel.load(files / "wander.xml")
    assert wrong.value.line == 6
    (files / "wander.xml").write_text(WANDER.replace("follower.Follower", "folower.Follower"))
    with pytest.raises(runnel.Error, match="did you mean 'follower'"):
        runnel.load(files / "wander.xml")


class Counter(runnel.Module):
    period = 0.01
    step = runnel.Parameter(1)
    names = runnel.Parameter("a b")
    weights = runnel.Parameter([1.0, 2.0])
    is_on = runnel.Parameter(True)
    out = runnel.Output("double[]")

    def __init__(self):
        self.count = 0

    def update(self):
        assert self.cycle_period == 0.01
        self.count += self.step if self.is_on else 0
        self.out.publish([self.count, self.now, *self.weights])


class Sum(runnel.Module):
    period = None
    numbers = runnel.Input("double[]", trigger=True)
    total = runnel.Output("double", unit="m")

    def update(self):
        self.total.publish(float(self.numbers.read().sum()))


def test_classes_composed_in_code():
    with runnel.compose("numbers", clock="simulated") as app:
        app.thread("control", 0.05)
        app.create("counter", Counter, step=2, weights=[3, 4])
        app.create("sum", Sum)
        app.connect("/counter/out", "/sum/numbers")
        app.run_for(0.1)
        assert app.read("/counter/out").tolist() == [20, pytest.approx(0.09), 3, 4]
        assert app.read("/sum/total") == pytest.approx(27.09)
        app["/counter/is_on"] = False
        app.run_for(0.1)
        assert app.read("/counter/out")[0] == 20


class Late(runnel.Module):
    """What it has of each of its inputs."""
    measured = runnel.Input("double", timeout=0.3)
    usual = runnel.Input("double")
    goal = runnel.Input("double", set_once=True)
    own = runnel.Input("double")
    own_timeout = runnel.Parameter(7.0)
    seen = runnel.Output("double[]")

    def update(self):
        self.seen.publish([float(each.read() is not None) for each in (self.measured, self.usual, self.goal, self.own)])


def test_what_is_old_is_not_read():
    with runnel.compose("late", clock="simulated") as app:
        app.thread("control", 0.05)
        app.create("late", Late)
        writers = [app.writer(f"/late/{name}") for name in ("measured", "usual", "goal", "own")]
        app.run_for(0.1)
        assert app.read("/late/seen").tolist() == [0, 0, 0, 0]
        for each in writers:
            each.publish(1.0)
        app.run_for(0.25)
        assert app.read("/late/seen").tolist() == [1, 1, 1, 1]
        app.run_for(0.2)
        assert app.read("/late/seen").tolist() == [0, 1, 1, 1]
        app.run_for(0.5)
        assert app.read("/late/seen").tolist() == [0, 0, 1, 1], "the class looks after the last one itself"
        assert app["/late/usual_timeout"] == 0.5 and app["/late/own_timeout"] == 7
        app["/late/measured_timeout"] = 60
        app.run_for(0.1)
        assert app.read("/late/seen").tolist() == [1, 0, 1, 1]
        with pytest.raises(runnel.Error):
            app["/late/goal_timeout"]


def test_a_thread_of_its_own_in_real_time():
    with runnel.compose("numbers") as app:
        app.create("counter", Counter)
        reader = app.reader("/counter/out", queue=50)
        app.start()
        while len(seen := list(reader)) < 1:
            assert reader.wait(10)
        assert seen[0].shape == (4,)
        app.quit()


def test_the_program_runs_them_too(files, program):
    done = subprocess.run([program, "run", "robot/wander.xml", "--duration", "5", "--fast"], capture_output=True, text=True)
    assert done.returncode == 0 and "simulated 5.00 s" in done.stdout + done.stderr, done.stderr
    (files / "follower.py").write_text("import nothing_of_that_name\n")
    done = subprocess.run([program, "check", "robot/wander.xml"], capture_output=True, text=True)
    assert done.returncode != 0 and "follower.py:1: error" in done.stderr and "ModuleNotFoundError" in done.stderr, done.stderr


def test_types_of_ports_are_found_in_plugins_that_nobody_has_loaded():
    text = """
import runnel

class Eye(runnel.Module):
    scan = runnel.Input("RangeScan")
    twist = runnel.Output("Twist2")
    def update(self):
        pass

app = runnel.compose("eyes", clock="simulated")
app.create("eye", Eye)
app.step(2)
print(app.paths("input"))
try:
    runnel.types.NoSuchType
except runnel.Error as error:
    print(error)
"""
    done = subprocess.run([sys.executable, "-"], input=text, capture_output=True, text=True)
    assert "'input', 'RangeScan'" in done.stdout and "no type 'NoSuchType'" in done.stdout, done.stderr


def test_cycles_of_modules_in_cpp_run_while_python_keeps_its_lock(xml):
    """Nobody but this thread can have the GIL meanwhile, and still values come."""
    before = sys.getswitchinterval()
    with runnel.load(xml / "apps/bug_demo.xml", clock="simulated", speed=20) as app:
        reader = app.reader("/world/pose", queue=10)
        sys.setswitchinterval(1000)
        try:
            app.start()
            seen, end = 0, time.monotonic() + 60
            while seen < 20 and time.monotonic() < end:
                seen += len(list(reader))
        finally:
            sys.setswitchinterval(before)
        assert seen >= 20


class Waiting(runnel.Module):
    period = 0.001
    updates = 0

    def update(self):
        Waiting.updates += 1


def test_on_a_real_clock_modules_in_cpp_do_not_wait_for_one_in_python_that_waits_for_the_lock():
    Waiting.updates = 0
    before = sys.getswitchinterval()
    with runnel.compose("demo", clock="real") as app:
        app.thread("control", 0.005)
        app.create("world", "simulation/world", world="rooms")
        app.create("waiting", Waiting)
        reader = app.reader("/world/pose", queue=10)
        app.start()
        end = time.monotonic() + 60
        while Waiting.updates < 3 and time.monotonic() < end:
            time.sleep(0.001)
        sys.setswitchinterval(1000)
        try:
            updates, seen = Waiting.updates, 0
            while seen < 20 and time.monotonic() < end:
                seen += len(list(reader))
            assert updates >= 3 and Waiting.updates <= updates + 1, "it waits, but for what it has asked for before"
            updates = Waiting.updates
        finally:
            sys.setswitchinterval(before)
        assert seen >= 20
        while Waiting.updates == updates and time.monotonic() < end:
            time.sleep(0.001)
        assert Waiting.updates > updates


def test_an_application_that_nobody_closes_ends_when_it_is_let_go_of():
    app = runnel.compose("numbers")
    app.create("counter", Counter)
    app.start()
    reader = app.reader("/counter/out")
    assert reader.wait(30)
    del app, reader
    gc.collect()


def test_a_process_ends_while_an_application_runs(files, program):
    text = """
import runnel

class Count(runnel.Module):
    period = 0.001
    out = runnel.Output("double")
    def update(self):
        self.out.publish(1.0)

app = runnel.compose("counting")
app.create("count", Count)
app.start()
assert app.reader("/count/out").wait(30)
print("seen")
"""
    done = subprocess.run([sys.executable, "-"], input=text, capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stdout) == (0, "seen\n"), done.stderr
