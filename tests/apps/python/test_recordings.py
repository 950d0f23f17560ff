import numpy
import pytest

import runnel


@pytest.fixture
def recorded(xml):
    with runnel.load(xml / "apps/bug_demo.xml", speed=0, record="run.mcap") as app:
        app.run_for(5)
        app.last = app.read("/world/pose"), app.read("/laser/scan")
    return runnel.read("run.mcap"), app.last


def test_values_by_path(recorded):
    recording, (pose, scan) = recorded
    assert "/bug_demo/world/sensor_output/pose" in recording.keys() and "/world/pose" in recording
    series = recording["/world/pose"]
    assert series.type == "Pose2" and len(series) == len(series.times)
    assert series["x"][-1] == pose.x and (numpy.diff(series.times) > 0).all()
    scans = recording["/laser/scan"]
    assert scans.values[-1] == scan and scans["ranges"].shape == (len(scans), len(scan.ranges))
    with pytest.raises(KeyError, match="did you mean"):
        recording["/world/poze"]
    assert recording.about["application"] == "bug_demo"


def test_tables_for_pandas(recorded):
    pytest.importorskip("pandas")
    recording, (pose, _) = recorded
    frame = recording["/world/pose"].frame()
    assert list(frame.columns) == ["x", "y", "heading"] and frame.index.name == "time"
    assert frame["x"].iloc[-1] == pose.x
    scans = recording["/laser/scan"].frame()
    assert scans["ranges"].iloc[0].shape == (181,) and scans["range_maximum"].iloc[0] == 4
    assert len(recording["/robot/planner/status"].frame()) == len(recording["/robot/planner/status"])


def test_pictures(recorded):
    pytest.importorskip("matplotlib")
    recording, (pose, scan) = recorded
    from matplotlib import pyplot

    axes = runnel.plot.way(recording["/world/pose"])
    runnel.plot.scan(scan, pose, axes=axes)
    assert len(axes.lines) == 2
    pyplot.figure()
    assert len(recording["/world/pose"].plot("x", "y").lines) == 2


def test_what_is_no_recording():
    open("bad.mcap", "w").write("nothing")
    with pytest.raises(runnel.Error) as bad:
        runnel.read("bad.mcap")
    assert bad.value.file.endswith("bad.mcap")
