import pathlib
import shutil
import subprocess

import pytest

import runnel
from runnel import arena

PLANNER = '''
import math

import runnel


class Straight(runnel.Module):
    """Drives straight to the goal, and knows nothing of obstacles."""

    period = 0.05
    pose = runnel.Input("Pose2")
    goal = runnel.Input("Point2")
    surroundings = runnel.Input("Surroundings")
    twist = runnel.Output("Twist2")
    status = runnel.Output("PlannerStatus")
    points = runnel.Output("HitAndLeavePoints")
    first_direction = runnel.Parameter("left")

    def update(self):
        pose, goal = self.pose.read(), self.goal.read()
        if pose is None or goal is None:
            return
        away = math.hypot(goal.x - pose.x, goal.y - pose.y)
        turn = math.remainder(math.atan2(goal.y - pose.y, goal.x - pose.x) - pose.heading, math.tau)
        self.twist.publish(forward=min(0.4, away), turn=2 * turn)
        self.status.publish(mode="reached" if away < 0.1 else "motion_to_goal", distance_to_goal=away)
'''


def test_worlds_as_objects_and_results_as_a_table():
    world = arena.World("one_box", start=(-3, 0), goal=(3, 0)).box(0, 0.2, length=1, width=2)
    table = arena.run([world, "open"], ["bug1", "bug2"], jobs=2)
    assert [(run["world"], run["variant"]) for run in table] == [
        ("one_box", "bug1"), ("one_box", "bug2"), ("open", "bug1"), ("open", "bug2")]
    assert {run["outcome"] for run in table} == {"reached"}
    assert table[0]["path_length_m"] > table[1]["path_length_m"] > 6
    assert str(table).splitlines()[0].startswith("world")
    assert [run["ratio"] for run in table] == [run["path_length_m"] / run["shortest_path_m"] for run in table]
    assert all(run["is_right"] and run["noise_m"] == 0 and run["remark"] == "" for run in table)
    table.write_csv("runs.csv")
    assert len(open("runs.csv").readlines()) == 5


def test_mistakes_are_told():
    with pytest.raises(runnel.Error, match="did you mean"):
        arena.run("opn", "bug2")
    with pytest.raises(runnel.Error, match="two worlds are called 'random'"):
        arena.run([arena.World("random", (0, 0), (3, y)) for y in range(4)], "bug2")
    with pytest.raises(runnel.Error, match="'b/c'"):
        arena.run(arena.World("b/c", (0, 0), (3, 0)), "bug2")


def test_why_a_variant_has_failed(empty_folder, monkeypatch):
    first = "        pose, goal = self.pose.read(), self.goal.read()\n"
    (empty_folder / "failing.py").write_text(PLANNER.replace(first, "        raise ValueError('no idea')\n"))
    monkeypatch.syspath_prepend(str(empty_folder))
    import failing

    run, = arena.run("open", failing.Straight, time_limit=5.0)
    assert not run["is_right"] and run["ratio"] is None and run["shortest_path_m"] > 0
    assert run["outcome"] == "error" and "no idea" in run["remark"], run


def test_shards_are_merged_and_interrupted_ones_resumed():
    choice = dict(worlds=["open", "one_obstacle"], variants=["bug1", "bug2"], jobs=1)
    for number in (1, 2, 3):
        arena.run(**choice, shard=(number, 3), json_file=f"part{number}.json")
    # The second is as if it had been killed before it wrote its only run.
    journal = pathlib.Path("part2.json.journal")
    lines = journal.read_text().splitlines(keepends=True)
    journal.write_text(lines[0] + lines[1][:40])
    assert len(arena.merge("all.json", "part1.json", "part2.json", "part3.json")) == 3
    arena.run(**choice, shard=(2, 3), json_file="part2.json", resume=True)
    whole = arena.merge("all.json", "part1.json", "part2.json", "part3.json")
    once = arena.run(**choice)

    def told(table):
        return sorted((run["world"], run["variant"], run["path_length_m"], run["outcome"]) for run in table)

    assert told(whole) == told(once)
    arena.run(**dict(choice, worlds=["open"]), noise=0.01, json_file="noisy.json")
    with pytest.raises(runnel.Error, match="other settings"):
        arena.merge("all.json", "part1.json", "noisy.json")


def test_by_gnu_parallel(program):
    if shutil.which("parallel") is None:
        pytest.skip("GNU parallel is not installed")
    words = f"{program} arena --world open --variant bug1,bug2 --shard {{}}/2 --jobs 1 --quiet --json part{{}}.json"
    subprocess.run(["parallel", "--will-cite", words, ":::", "1", "2"], check=True, capture_output=True)
    assert len(arena.merge("all.json", "part1.json", "part2.json")) == 2


def test_a_variant_in_python(empty_folder, monkeypatch):
    (empty_folder / "straight.py").write_text(PLANNER)
    monkeypatch.syspath_prepend(str(empty_folder))
    import straight

    table = arena.run("open", [straight.Straight, "bug2"], jobs=2)
    assert [run["outcome"] for run in table] == ["reached", "reached"], table
