import threading

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


class Speaker(runnel.Module):
    """An output of each kind of type: numbers, texts, lists, enumerations, structures, lists of structures."""

    period = 0.1
    kind = runnel.Parameter("")

    def make_ports(self):
        return {name: runnel.Output(type) for name, (type, _) in SPOKEN.items()}

    def update(self):
        for name, (_, value) in SPOKEN.items():
            getattr(self, name).publish(value)


SPOKEN = {"number": ("double", 1.5), "flag": ("bool", True), "text": ("string", 'a "b"'), "count": ("int64", -3),
          "state": ("GateState", "never_came"), "numbers": ("double[]", [1.0, 2.5]), "samples": ("float[]", [0.5]),
          "bytes": ("uint8[]", [7, 8]), "pose": ("Pose2", {"x": 1.0, "y": 2.0, "heading": 0.5}),
          "way": ("Path2", {"points": [{"x": 1.0, "y": 2.0}]})}


def test_every_type_of_port():
    with runnel.compose("speaking", clock="simulated") as app:
        app.create("gate", "motion/command_gate")  # which has states of a gate
        app.create("speaker", Speaker)
        with app.record("all.mcap", ["/speaker/*"]):
            app.run_for(0.3)
        last = {name: app.read(f"/speaker/{name}") for name in SPOKEN}
    recording = runnel.read("all.mcap")
    assert len(recording) == len(SPOKEN)
    for name, (type, value) in SPOKEN.items():
        series = recording[f"/speaker/{name}"]
        assert (series.type, len(series)) == (type, 3)
        if name == "pose":
            assert series.values[-1].tolist() == (1.0, 2.0, 0.5)
        else:
            same = series.values[-1] == last[name]
            assert same.all() if isinstance(same, numpy.ndarray) else same, (name, series.values)


def test_several_threads_read_one_recording(recorded):
    recording, (_, scan) = recorded
    found, wrong = [], []

    def read():
        try:
            for _ in range(10):
                found.append(recording["/laser/scan"].values[-1] == scan)
        except BaseException as error:
            wrong.append(error)

    threads = [threading.Thread(target=read) for _ in range(4)]
    for each in threads:
        each.start()
    for each in threads:
        each.join()
    assert not wrong and found == [True] * 40, wrong[:1]


# Not those that need another end: a robot beside, GenoM3's components.
SHIPPED = ["behaviour_demo", "bug_bumper", "bug_demo", "bug_failing_laser", "bug_infrared", "places_demo"]


@pytest.mark.parametrize("name", SHIPPED)
def test_whatever_shipped_applications_publish_is_read(name):
    with runnel.load(name, clock="simulated", speed=0, record="all.mcap") as app:
        app.run_for(0.5)
        last = {}
        for path, kind, _ in app.paths():
            if kind == "output":
                try:
                    last[path] = app.read(path)
                except runnel.Error as error:
                    assert "only a module can make" in str(error) or "nobody makes" in str(error), error
    recording = runnel.read("all.mcap")
    assert len(recording) > 5
    for path in recording:
        series = recording[path]
        assert len(series) == len(series.values), path
        if isinstance(last.get(path), (bool, int, float, str, runnel.Value)) and len(series) > 0:
            value = series.values[-1]
            same = value == last[path] if not isinstance(value, numpy.void) else value["x"] == last[path]["x"] if "x" in value.dtype.names else True
            assert same, (path, value, last[path])


def test_what_is_no_recording():
    open("bad.mcap", "w").write("nothing")
    with pytest.raises(runnel.Error) as bad:
        runnel.read("bad.mcap")
    assert bad.value.file.endswith("bad.mcap")
