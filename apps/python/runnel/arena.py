"""Planners compared over worlds: `runnel.arena.run(worlds, variants)`, by the program `runnel arena`."""

import csv
import dataclasses
import inspect
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
from xml.sax.saxutils import quoteattr

from runnel import _extension

COLUMNS = ("world", "variant", "sensor", "direction", "seed", "noise_m", "outcome", "is_right", "path_length_m", "shortest_path_m",
           "ratio", "sim_time_s", "wall_time_s", "cycles", "remark")


@dataclasses.dataclass
class World:
    """A world with start and goal; lengths in m, angles in rad. xml/worlds shows what such files look like.

    >>> world = World("one_box", start=(-3, 0), goal=(3, 0)).box(0, 0, length=1, width=2)
    >>> print(world.text())
    <world name="one_box">
      <start x="-3" y="0"/>
      <goal x="3" y="0"/>
      <box x="0" y="0" length="1" width="2"/>
    </world>
    <BLANKLINE>
    """

    name: str
    start: tuple
    goal: tuple
    parts: list = dataclasses.field(default_factory=list)

    def _add(self, tag, inside=(), **attributes):
        said = "".join(f" {name}={quoteattr(f'{value:g}' if isinstance(value, (int, float)) else value)}"
                       for name, value in attributes.items() if value is not None)
        self.parts.append(f"  <{tag}{said}/>" if not inside else f"  <{tag}{said}>" + "".join(inside) + f"</{tag}>")
        return self

    def box(self, x, y, length, width, heading=None):
        """A box with its middle at (x, y)."""
        return self._add("box", x=x, y=y, heading=heading, length=length, width=width)

    def polygon(self, points):
        """A solid with these corners."""
        return self._add("polygon", [f'<point x="{x:g}" y="{y:g}"/>' for x, y in points])

    def text(self):
        """The file of the world."""
        heading = f' heading="{self.start[2]:g}"' if len(self.start) > 2 else ""
        return "\n".join([f"<world name={quoteattr(self.name)}>", f'  <start x="{self.start[0]:g}" y="{self.start[1]:g}"{heading}/>',
                          f'  <goal x="{self.goal[0]:g}" y="{self.goal[1]:g}"/>', *self.parts, "</world>", ""])


class Table(list):
    """Runs, a dict each: COLUMNS, hits, leaves, path.

    is_right -- whether the verdict is the true one; shortest_path_m -- None where the goal cannot be reached; ratio -- of the path to
    it, None where it was not rightly reached; remark -- why a run has failed.
    """

    def frame(self):
        """The same for pandas, without the paths."""
        import pandas

        return pandas.DataFrame([{name: run.get(name) for name in COLUMNS} for run in self], columns=list(COLUMNS))

    def write_csv(self, file):
        """The same as a CSV file."""
        with open(file, "w", newline="") as out:
            writer = csv.DictWriter(out, COLUMNS, extrasaction="ignore")
            writer.writeheader()
            writer.writerows(self)

    def __str__(self):
        rows = [[_text(run.get(name)) for name in COLUMNS] for run in self]
        widths = [max(map(len, column)) for column in zip(COLUMNS, *rows)]
        return "\n".join("  ".join(each.ljust(width) for each, width in zip(row, widths)).rstrip() for row in [COLUMNS, *rows])


def _text(value):
    return "-" if value is None else str(round(value, 3) if isinstance(value, float) else value)


def program(name="runnel"):
    """Where a program of Runnel is: beside this package's tree, or in PATH."""
    for folder in pathlib.Path(_extension.__file__).resolve().parents:
        if (folder / "bin" / name).is_file():
            return str(folder / "bin" / name)
    found = shutil.which(name)
    if found is None:
        raise FileNotFoundError(f"the program '{name}' is not installed: apt install runnel, or put its folder into PATH")
    return found


def run(worlds, variants=("all",), sensors=("laser",), directions=("left",), seeds=(1,), noise=0.0, jobs=None, time_limit=1800.0,
        safe_distance=0.35, json_file=None, shard=None, resume=False, html=None, plugins=()):
    """Lets each variant find its way through each world, with each sensor, direction and seed; the runs as a Table.

    worlds -- names, files or World; variants -- "all", names ("bug1"), module types, .xml files with a <module>, or classes in
    Python (below runnel.Module, in a file of their own); noise -- standard deviation of the ranges (m); jobs -- at the same
    time, None: as many as there are cores; time_limit -- s, simulated; json_file -- keeps the runs, with a journal from which
    `resume` goes on; shard -- (1, 4): the first of four parts, see merge().
    """
    with tempfile.TemporaryDirectory() as folder:
        words, environment = _words(folder, worlds, variants, list(plugins))
        file = str(json_file or pathlib.Path(folder) / "runs.json")
        command = [program("runnel-arena"), *words, "--sensor", ",".join(sensors), "--direction", ",".join(directions),
                   "--seed", ",".join(map(str, seeds)), "--noise", repr(float(noise)), "--time-limit", repr(float(time_limit)),
                   "--safe-distance", repr(float(safe_distance)), "--jobs", str(jobs or os.cpu_count() or 1), "--quiet", "--json", file]
        command += ["--shard", f"{shard[0]}/{shard[1]}"] if shard is not None else []
        command += ["--resume"] if resume else []
        command += ["--html", str(html)] if html is not None else []
        _ask(command, environment)
        return read(file)


def merge(into, *parts):
    """The runs of several json_file in one; the whole as a Table."""
    _ask([program("runnel-arena"), "merge", str(into), *map(str, parts)], os.environ)
    return read(into)


def read(file):
    """The runs of a json_file."""
    return Table(json.loads(pathlib.Path(file).read_text()))


def _ask(command, environment):
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    if done.returncode != 0:
        raise _extension.Error(done.stderr.strip() or done.stdout.strip() or f"{command[0]} has ended with {done.returncode}")


def _words(folder, worlds, variants, plugins):
    files, texts = [], {}
    for each in [worlds] if isinstance(worlds, (str, pathlib.Path, World)) else worlds:
        if isinstance(each, World):
            if not each.name or "/" in each.name:
                raise _extension.Error(f"a world is called as a file may be, without '/': not {each.name!r}")
            if texts.setdefault(each.name, each.text()) != each.text():
                raise _extension.Error(f"two worlds are called '{each.name}'")
            file = pathlib.Path(folder) / f"{each.name}.xml"
            file.write_text(each.text())
            each = file
        files.append(str(each))
    names, python_path = [], [os.environ.get("RUNNEL_PYTHON_PATH", "")]
    for each in [variants] if isinstance(variants, (str, type)) else variants:
        if isinstance(each, type):
            source = pathlib.Path(inspect.getfile(each)).resolve()
            python_path.append(str(source.parent))
            each = f"python/{source.stem}.{each.__qualname__}"
            plugins.append("python")
        names.append(str(each))
    environment = dict(os.environ, RUNNEL_PYTHON_PATH=os.pathsep.join(filter(None, python_path)))
    if "python" in plugins:
        package = str(pathlib.Path(_extension.__file__).resolve().parent.parent)
        environment["PYTHONPATH"] = os.pathsep.join(filter(None, [package, os.environ.get("PYTHONPATH", "")]))
    words = ["--world", *files, "--variant", ",".join(names)]
    return words + (["--plugin", ",".join(dict.fromkeys(plugins))] if plugins else []), environment
