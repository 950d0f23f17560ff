import asyncio
import os

import pytest

import runnel


@pytest.fixture
def app(xml):
    with runnel.load(xml / "apps/bug_demo.xml", speed=0) as app:
        yield app


def test_a_run_reaches_the_goal_and_says_so(app):
    assert app.run() > 10
    verdict, is_good = app.verdict()
    assert verdict.startswith("reached") and is_good


def test_composed_in_code():
    with runnel.compose("demo", clock="simulated") as app:
        app.thread("control", 0.05)
        app.create("world", "simulation/world", world="rooms")
        app.create("robot/planner", "planning/bug2", cruise_speed=0.3)
        app.connect("/world/goal", "/robot/planner/goal", queue=3)
        assert app["/robot/planner/cruise_speed"] == 0.3
        app.step(3)
        assert app.time == pytest.approx(0.1)
        assert app.read("/world/goal") == app.read("/robot/planner/goal")
        app.delete("/robot/planner")
        app.undo()
        assert ("/demo/robot/planner", "module", "planning/bug2") in app.paths("module")


def test_reads_what_has_a_name_now_after_a_rename():
    with runnel.compose("demo", clock="simulated") as app:
        app.thread("control", 0.05)
        app.create("world", "simulation/world", world="rooms")
        app.step(2)
        assert app.read("/world/goal") is not None
        app.apply("rename /demo/world other")
        assert app.read("/other/goal") is not None
        with pytest.raises(runnel.Error):
            app.read("/world/goal")
        app.undo()
        assert app.read("/world/goal") is not None
        with pytest.raises(runnel.Error):
            app.read("/other/goal")


def test_changes_are_undone_and_refused_with_the_nearest_name(app):
    app.run_for(1)
    app.swap("/robot/planner", "planning/tangent_bug")
    app.undo()
    app.redo()
    assert ("/bug_demo/robot/planner", "module", "planning/tangent_bug") in app.paths("module")
    with pytest.raises(runnel.Error) as refused:
        app.swap("/robot/planner", "planning/bug_2")
    assert refused.value.path == "/bug_demo/robot/planner" and "did you mean" in refused.value.hint
    with pytest.raises(runnel.Error, match="did you mean 'planner'"):
        app.read("/robot/planer/twist")


def test_errors_of_files_have_places(empty_folder):
    (empty_folder / "bad.xml").write_text('<application name="bad">\n  <modul name="x"/>\n  <grup/>\n</application>\n')
    with pytest.raises(runnel.Error) as bad:
        runnel.load("bad.xml")
    assert [each.line for each in bad.value.errors] == [2, 3]
    assert bad.value.file.endswith("bad.xml") and "module" in bad.value.hint


def test_parameters(app):
    app.run_for(1)
    app["/robot/planner/cruise_speed"] = 0.25
    assert app.get("/robot/planner/cruise_speed") == 0.25
    with pytest.raises(runnel.Error):
        app["/robot/planner/cruise_speed"] = -5
    with pytest.raises(runnel.Error):
        app["/robot/planner/cruise_speed"] = "fast"
    assert app["/world/goal"].type.name == "Point2"
    with pytest.raises(runnel.Error, match="did you mean 'pose'"):
        app["/world/poze"]
    with pytest.raises(runnel.Error, match="did you mean 'cruise_speed'"):
        app["/robot/planner/cruise_sped"]


def test_each_value_of_a_queue(app):
    reader = app.reader("/world/pose", queue=100)
    app.run_for(1)
    values = list(reader)
    assert len(values) >= 20 and reader.dropped == 0
    assert values[-1] == app.read("/world/pose")
    assert reader.timestamp == pytest.approx(0.95)


def test_publishing_by_a_writer_and_by_hand(app):
    writer = app.writer("/robot/drive/twist")
    writer.publish(forward=1.5)
    assert app.read("/robot/drive/twist").forward == 1.5
    app.publish("/robot/drive/twist", {"turn": 1})
    assert app.read("/robot/drive/twist") == runnel.make("Twist2", turn=1)
    app.release("/robot/drive/twist")
    assert app.read("/robot/drive/twist").forward == 1.5, "of this very moment"
    with pytest.raises(runnel.Error, match="did you mean 'forward'"):
        writer.publish(forwart=1)


def test_services(xml):
    with runnel.load(xml / "apps/places_demo.xml", speed=0) as app:
        app.run_for(1)
        pose = app.call("/book/remember", name="here")
        assert pose == app.call("/book/where", name="here")
        assert "here" in app.call("/book/names")
        with pytest.raises(runnel.Error, match="did you mean 'here'"):
            app.call("/book/where", name="hre")
        with pytest.raises(TypeError):
            app.call("/book/where")
        with pytest.raises(runnel.Error, match="no service"):
            app.call("/world/pose")


def test_recorded_and_replayed_to_the_bit(xml):
    file = xml / "apps/bug_demo.xml"
    with runnel.load(file, speed=0, record="run.mcap") as app:
        app.run_for(20)
        end = app.read("/robot/planner/twist")
    with runnel.replay("run.mcap", file, ports=["/laser/*", "/localisation/*"], speed=0) as again:
        again.run_for(20)
        assert again.read("/robot/planner/twist") == end
    with runnel.replay("run.mcap", "bug_demo", ports=["/laser/*"], speed=0) as by_name:
        by_name.step()


def test_what_comes_with_runnel_has_a_name_and_is_saved_elsewhere():
    with runnel.load("bug_demo", speed=0) as app:
        with pytest.raises(runnel.Error, match="comes with Runnel") as refused:
            app.save()
        assert "a file of your own" in refused.value.hint
        app.save("mine.xml")
    with pytest.raises(runnel.Error, match="bug_dem"):
        runnel.load("bug_dem")


def test_files_of_who_judges_are_written_at_the_end(xml):
    def run():
        with runnel.load(xml / "apps/bug_demo.xml", speed=0, settings={"picture": "way.svg"}) as app:
            app.run_for(1)

    run()
    assert "<svg" in open("way.svg").read()
    os.remove("way.svg")
    os.mkdir("way.svg")
    with pytest.warns(UserWarning, match="could not be written"):
        run()


def test_saved_and_loaded_again(app):
    app["/robot/planner/cruise_speed"] = 0.25
    app.save("mine.xml")
    with pytest.raises(runnel.Error, match="overwrite"):
        app.save("mine.xml")
    with runnel.load("mine.xml") as again:
        assert again["/robot/planner/cruise_speed"] == 0.25


def test_threads_of_its_own_and_values_as_they_come(xml):
    with runnel.load(xml / "apps/bug_demo.xml", speed=20) as app:
        app.start()
        assert app.is_running

        async def five():
            found = []
            async for pose in app.values("/world/pose"):
                found.append(pose)
                if len(found) == 5:
                    return found

        poses = asyncio.run(five())
        assert len({pose.x for pose in poses}) > 1
        app.pause()
        app.step(2)
        app.resume()
        app.quit()
        assert not app.is_running


def test_nobody_deletes_what_a_reader_reads_by(app):
    reader = app.reader("/world/pose")
    with pytest.raises(runnel.Error, match="made for itself"):
        app.delete("/python")
    app.run_for(0.1)
    assert reader.read() is not None


def test_a_closed_application_says_so(app):
    reader = app.reader("/world/pose")
    app.close()
    app.close()
    with pytest.raises(ValueError, match="closed"):
        app.step()
    with pytest.raises(ValueError, match="closed"):
        reader.read()


def test_what_happened_is_in_the_log(app):
    app.swap("/robot/planner", "planning/bug1")
    assert app.log()[-1].kind == "change" and "planning/bug1" in app.log()[-1].text
    assert app.log(len(app.log())) == []


def test_recorded_from_now_on(app):
    app.run_for(1)
    with app.record("part.mcap", ports=["/world/*"]) as recording:
        app.run_for(2)
        assert recording.progress()
    app.run_for(1)
    series = runnel.read("part.mcap")["/world/pose"]
    assert 0.9 <= series.times[0] <= 1.1 and 2.8 <= series.times[-1] <= 3.0
    assert "/laser/scan" not in runnel.read("part.mcap")
    with pytest.raises(runnel.Error):
        app.record("no_such_folder/part.mcap")
    open_end = app.record("end.mcap")
    app.run_for(1)
    app.close()
    assert len(runnel.read("end.mcap")["/world/pose"]) > 10
    assert open_end.close() == "finished"
