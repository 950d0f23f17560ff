"""The table of losses (tests/integration/losses_test.cpp) for a robot that a module in Python drives, and for one whose
planner is another process."""

import concurrent.futures
import os
import pathlib
import re
import signal
import subprocess
import threading
import time

import numpy
import pytest

import runnel

LOST, BACK, END = 6.0, 36.0, 48.0
RESTED = 1.5  # s: the time-out of 0.5 s, then drive and body come to rest
WAYS = ("never comes", "ceases", "disconnected", "stale", "not measured", "partly not measured", "no number",
        "source deleted", "source swapped", "source stuck")
MEASURED_BY = {"not measured": 0.0, "partly not measured": 0.4, "no number": 1.0}

stuck = threading.Event()


class Follower(runnel.Module):
    """As apps/documentation/pages/how_to/python.md has it, but that it can be made stuck."""

    period = 0.05
    scan = runnel.Input("RangeScan", required=True)
    twist = runnel.Output("Twist2")
    distance = runnel.Parameter(0.6, unit="m", bounds=(0.2, 3.0))

    def update(self):
        while stuck.is_set():
            time.sleep(0.01)
        scan = self.scan.new()
        if scan is None or scan.ranges.size == 0 or numpy.isnan(scan.ranges).any():
            return
        near = scan.ranges.min() < self.distance
        self.twist.publish(forward=0.0 if near else 0.4, turn=1.0 if near else 0.0)


VALUES = (("/laser/scan", "/follower/scan", "simulation/laser"),
          ("/follower/twist", "/drive/twist", Follower),
          ("/drive/wheels", "/world/wheels", "motion/differential_drive"))


def printed():
    return (pathlib.Path(os.environ["RUNNEL_XML"]).parent / "apps/documentation/pages/concepts/losses.md").read_text()


def composed(clock):
    app = runnel.compose("python", clock=clock)
    app.thread("control", 0.05)
    app.create("world", "simulation/world", world="rooms")
    app.create("laser", "simulation/laser")
    app.create("follower", Follower, distance=0.7)
    app.create("drive", "motion/differential_drive")
    app.connect("/world/scene", "/laser/scene")
    app.connect("/world/pose", "/laser/pose")
    for source, sink, _ in VALUES:
        app.connect(source, sink)
    return app


def place(app):
    pose = app.read("/world/pose")
    return numpy.array([pose.x, pose.y, pose.heading]) if pose is not None else numpy.zeros(3)


def moved(app, seconds):
    before, way = place(app), 0.0
    for _ in range(round(seconds / 0.5)):
        app.run_for(0.5)
        before, last = place(app), before
        way += abs(before - last).sum()
    return way


def spoiled(app, value, way):
    """None: the value has no such state."""
    if value.endswith("scan"):
        scan = app.read(value).copy()
        ranges = numpy.array(scan.ranges)
        if way == "not measured":
            return runnel.types.RangeScan()
        first = len(ranges) // 4 if way == "partly not measured" else 0
        ranges[first:first + int(MEASURED_BY[way] * len(ranges))] = numpy.nan
        scan.ranges = ranges
        return scan
    if way == "no number":
        nan = float("nan")
        if value.endswith("pose"):
            return {"x": nan, "y": nan, "heading": nan}
        return {"forward": nan, "turn": nan} if value.endswith("twist") else {"left": nan, "right": nan}
    return None


def lose(app, value, sink, type, way):
    source = value[:value.rindex("/")]
    if way in ("never comes", "disconnected"):
        app.disconnect(value, sink)
    elif way == "ceases":
        app.pause(source)
    elif way == "source deleted":
        app.delete(source)
    elif way == "source swapped":
        app.swap(source, type)
    else:
        app.publish(value, app.read(value) if way == "stale" else spoiled(app, value, way))


def bring_back(app, value, sink, way):
    source = value[:value.rindex("/")]
    if way in ("never comes", "disconnected"):
        app.connect(value, sink)
    elif way == "ceases":
        app.resume(source)
    elif way == "source deleted":
        app.undo()
    elif way != "source swapped":
        app.release(value)


def tried(value, sink, type, way):
    with composed("simulated") as app:
        if way == "never comes":
            lose(app, value, sink, type, way)
        else:
            moved(app, LOST - 1.0)
            if moved(app, 1.0) < 0.05:
                return "did not drive before"
            if way in MEASURED_BY and spoiled(app, value, way) is None:
                return "-"
            lose(app, value, sink, type, way)
        moved(app, RESTED)
        way_lost = 0.0
        for _ in range(round((BACK - LOST - RESTED) / 0.5)):
            if way in MEASURED_BY:  # as somebody does who measures nothing, with a new stamp each time
                app.publish(value, spoiled(app, value, way))
            way_lost += moved(app, 0.5)
        if way_lost > 1e-6 and way != "source swapped":
            return "DRIVES ON"
        bring_back(app, value, sink, way)
        if moved(app, END - BACK) < 0.5:
            return "stands for ever"
        assert not [each for each in app.faults() if not re.search("safe value|be reached", each.text)]
        return "goes on" if way_lost > 1e-6 else "stands, goes on"


def waits(app, drives):
    for _ in range(120):
        before = place(app)
        time.sleep(0.5)
        if (abs(place(app) - before).sum() > 1e-6) == drives:
            return True
    return False


def tried_stuck():
    with composed("real") as app:
        app.start()
        try:
            if not waits(app, True):
                return "did not drive before"
            stuck.set()
            if not waits(app, False):
                return "DRIVES ON"
            rest = place(app)
            time.sleep(2.5)
            if abs(place(app) - rest).sum() > 1e-6:
                return "DRIVES ON"
            stuck.clear()
            return "stands, goes on" if waits(app, True) else "stands for ever"
        finally:
            stuck.clear()
            app.quit()


def test_a_robot_that_does_not_know_stands():
    rows = []
    for value, sink, type in VALUES:
        cells = [(tried_stuck() if type is Follower else "-") if way == "source stuck" else tried(value, sink, type, way) for way in WAYS]
        rows.append("| python" + value + " | " + " | ".join(cells) + " |\n")
    assert "".join(rows) in printed(), "".join(rows)


# Two processes, in real time: 3 s.

TWO_VALUES = (("robot", "/laser/scan", "simulation/laser"),
              ("robot", "/localisation/pose", "simulation/localisation"),
              ("planner", "/planner/planner/twist", "planning/bug1"))


class Pair:
    """The robot and its planner, each in a process; `without`: what is not offered at first."""

    connecting = threading.Lock()

    def __init__(self, folder, domain, program, xml, without=""):
        self.folder, self.program = folder, program
        (folder / "run").mkdir(parents=True, mode=0o700)
        self.environment = dict(os.environ, XDG_RUNTIME_DIR=str(folder / "run"), ROS_DOMAIN_ID=str(domain))
        short = without.removeprefix("/planner")[1:]
        for name in ("two_robots.xml", "two_robots_planner.xml"):
            text = (xml / "apps" / name).read_text().replace("../worlds", str(xml / "worlds"))
            (folder / name).write_text(text.replace('ports="' + short + " ", 'ports="').replace(" " + short + '"', '"'))
        self.processes = {}
        self.far = {}
        for name, file in (("robot", "two_robots.xml"), ("planner", "two_robots_planner.xml")):
            self.start(name, file)

    def __enter__(self):
        return self

    def __exit__(self, *unused):
        for process in self.processes.values():
            process.kill()
            process.wait()

    def start(self, name, file):
        self.processes[name] = subprocess.Popen([self.program, "run", file, "--quiet"], cwd=self.folder, env=self.environment,
                                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        for _ in range(600):
            with Pair.connecting:
                os.environ["XDG_RUNTIME_DIR"] = str(self.folder / "run")
                try:
                    self.far[name] = runnel.connect(name)
                    return
                except runnel.Error:
                    pass
            time.sleep(0.1)
        raise AssertionError(f"{name} does not begin")

    def waits(self, drives):
        return waits(self.far["robot"], drives)


def tried_as_two(pair, name, value, type, way):
    far, source = pair.far[name], value[:value.rindex("/")]
    process = pair.processes[name]
    other = way == "never comes"
    if not other and not pair.waits(True):
        return "did not drive before"
    bad = spoiled(far, value, way) if way in MEASURED_BY else None
    if way == "disconnected":
        far.apply(f"offer {value} remove=true")
    elif way == "ceases":
        far.pause(source)
    elif way == "source deleted":
        process.kill() if name == "planner" else far.delete(source)
    elif way == "source swapped":
        far.swap(source, type)
        return "goes on" if pair.waits(True) else "stands for ever"
    elif way == "source stuck":
        process.send_signal(signal.SIGSTOP)
    elif not other:
        far.publish(value, far.read(value) if bad is None else bad)
    if not pair.waits(False):
        return "DRIVES ON"
    rest = place(pair.far["robot"])
    for _ in range(10):
        if bad is not None:
            far.publish(value, bad)
        time.sleep(0.25)
    if abs(place(pair.far["robot"]) - rest).sum() > 1e-6:
        return "DRIVES ON"
    if way == "never comes":
        far.apply(f"offer {value}")
    elif way == "ceases":
        far.resume(source)
    elif way == "source deleted" and name == "planner":
        process.wait()
        pair.start(name, "two_robots_planner.xml")
    elif way in ("source deleted", "disconnected"):
        far.undo()
    elif way == "source stuck":
        process.send_signal(signal.SIGCONT)
    else:
        far.release(value)
    return "stands, goes on" if pair.waits(True) else "stands for ever"


def column_of_two(folder, domain, program, xml, way):
    cells = []
    for i, (name, value, type) in enumerate(TWO_VALUES):
        has_it = (way == "no number" or way not in MEASURED_BY or value.endswith("scan")) and (way != "source stuck" or name == "planner")
        if not has_it:
            cells.append("-")
            continue
        with Pair(folder / str(i), domain, program, xml, value if way == "never comes" else "") as pair:
            cells.append(tried_as_two(pair, name, value, type, way))
    return cells


def test_a_robot_whose_planner_is_another_process_stands(empty_folder, program, xml):
    if not list((pathlib.Path(program).parent.parent / "lib").rglob("*wire_cyclone*")):
        pytest.skip("no engine for the network")
    with concurrent.futures.ThreadPoolExecutor(len(WAYS)) as pool:
        columns = [pool.submit(column_of_two, empty_folder / str(i), 1 + (os.getpid() + i) % 100, program, xml, way)
                   for i, way in enumerate(WAYS)]
        columns = [each.result() for each in columns]
    rows = ["| two processes" + value + " | " + " | ".join(column[i] for column in columns) + " |\n"
            for i, (_, value, _) in enumerate(TWO_VALUES)]
    assert "".join(rows) in printed(), "".join(rows)
