import asyncio

import pytest

import runnel


@pytest.fixture
def served(xml):
    with runnel.load(xml / "apps/bug_demo.xml", speed=5, control=True) as app:
        app.start()
        reader = app.reader("/laser/scan")
        assert reader.wait(30)
        yield app


@pytest.fixture
def app(served):
    with runnel.connect("bug_demo") as app:
        yield app


def test_is_found_by_name_and_process(served):
    assert list(runnel.applications().values()) == ["bug_demo"]
    process = next(iter(runnel.applications()))
    with runnel.connect(process) as app:
        assert app.process == process and app.name == "bug_demo" and app.file.endswith("bug_demo.xml")
    with runnel.connect() as app:
        assert app.name == "bug_demo"
    with pytest.raises(runnel.Error, match="there is bug_demo"):
        runnel.connect("bug")


def test_values_are_the_same_objects_as_at_home(app):
    pose = app.read("/world/pose")
    assert pose.type.name == "Pose2" and isinstance(pose.x, float)
    assert app.read("/laser/scan").ranges.dtype == "float32"
    app["/robot/planner/cruise_speed"] = 0.25
    assert app["/robot/planner/cruise_speed"] == 0.25


def test_changes_and_their_errors(app):
    app.swap("/robot/planner", "planning/bug1")
    assert ("/bug_demo/robot/planner", "module", "") in app.paths("module")
    app.undo()
    with pytest.raises(runnel.Error) as refused:
        app.swap("/robot/planner", "planning/bug_2")
    assert refused.value.path == "/bug_demo/robot/planner" and "did you mean" in refused.value.hint
    with pytest.raises(runnel.Error, match="did you mean 'planner'"):
        app.get("/robot/planer/twist")
    app.publish("/robot/drive/twist", {"forward": 0.1})
    app.release("/robot/drive/twist")
    app.save("saved.xml")
    with pytest.raises(runnel.Error, match="config is 'yes' or left out, not 'True'"):
        app.ask("save", config=True)  # which saved the application
    assert "undo" in " ".join(app.log()) or app.log()


def test_time_is_paused_and_stepped(app):
    app.pause()
    before = app.read("/world/pose")
    app.step(4)
    assert app.read("/world/pose") is not None and before is not None
    app.resume()


def test_values_as_they_come(app):
    async def three():
        found = []
        async for time, value in app.values("/world/pose"):
            found.append((time, value))
            if len(found) == 3:
                return found

    found = asyncio.run(three())
    assert found[0][0] < found[1][0] < found[2][0] and found[0][1].type.name == "Pose2"

    async def wrong():
        async for _ in app.values("/world/pse"):
            pass

    with pytest.raises(runnel.Error, match="did you mean 'pose'"):
        asyncio.run(wrong())


def test_recorded_from_outside(app, served):
    reader = served.reader("/world/pose", queue=1000)
    with app.record("far.mcap"):
        list(reader)
        for _ in range(5):
            assert reader.wait(30)
            list(reader)
    assert len(runnel.read("far.mcap")["/world/pose"]) >= 1


class Speaker(runnel.Module):
    text = runnel.Parameter("")
    out = runnel.Output("string")

    def update(self):
        self.out.publish(self.text)


TEXTS = ["one", "next\x85line", "para\u2029graph\u2028line", "a\nb\n", "\n", "a\r\n", "", "none  (3 not shown)",
         "a\n1.000 s  (measured at 1.000 s, 0 not shown)  b"]


@pytest.mark.parametrize("text", TEXTS)
def test_texts_come_as_they_are_whatever_is_in_them(text):
    async def first():
        async for _, value in remote.values("/speaker/out"):
            return value

    with runnel.compose("demo", control=True) as app:
        app.thread("control", 0.01)
        app.create("speaker", Speaker)
        app.set("/speaker/text", text)
        app.start()
        assert app.reader("/speaker/out").wait(30)
        with runnel.connect("demo") as remote:
            assert (remote.read("/speaker/out"), remote["/speaker/text"]) == (text, text)
            assert asyncio.run(first()) == text
