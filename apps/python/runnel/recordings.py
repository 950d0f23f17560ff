"""Recordings (MCAP) as arrays and tables: `runnel.read("run.mcap")["/robot/planner/twist"]`."""

import difflib
import json

import numpy

from runnel import _extension


def read(file):
    """The recording in a file, also one that was never finished."""
    return Recording(file)


class Recording:
    """What ports have published: ``recording[path]`` is a Series of one; iterating gives the paths.

    >>> recording = runnel.read(recorded)
    >>> series = recording["/world/pose"]
    >>> float(series.times[0]), series.type
    (0.0, 'Pose2')
    >>> series["x"].shape == series.times.shape
    True
    """

    def __init__(self, file):
        self._file = _extension.RecordingFile(str(file))
        self._channels = {path: (channel, type, encoding, count)
                          for channel, path, type, encoding, count, is_view in self._file.channels() if not is_view}
        self.file = str(file)

    @property
    def about(self):
        """What was recorded: application, file, clock, version."""
        return self._file.about()

    def __iter__(self):
        return iter(sorted(self._channels))

    def __len__(self):
        return len(self._channels)

    def __contains__(self, path):
        return self._find(path) is not None

    def __repr__(self):
        return f"<recording {self.file}: {len(self)} ports>"

    def keys(self):
        """The paths of the ports."""
        return sorted(self._channels)

    def _find(self, path):
        # As everywhere: the application and the group of a port may be left out.
        wanted = [part for part in path.split("/") if part]
        fits = []
        for each in self._channels:
            parts = each.strip("/").split("/")
            short = parts[:-2] + parts[-1:]
            if wanted in (parts, short, parts[1:], short[1:]):
                fits.append(each)
        return fits[0] if len(fits) == 1 else None

    def __getitem__(self, path):
        found = self._find(path)
        if found is None:
            near = difflib.get_close_matches(path, self.keys() + [_short(each) for each in self.keys()], 1)
            hint = f"; did you mean '{near[0]}'?" if near else f"; there is {', '.join(self.keys()[:20])}"
            raise KeyError(f"{self.file} has no port '{path}'{hint}")
        channel, type, encoding, _ = self._channels[found]
        try:
            known = type if encoding == "json" and _extension.type_named(type) else ""
        except _extension.Error:
            known = ""  # recorded elsewhere: values are what JSON makes of them
        published, measured, values = self._file.read(channel, known)
        if not known and encoding == "json":
            values = [json.loads(each) for each in values]
        return Series(found, type, published, measured, values)


class Series:
    """The values of one port: `times` when they were published, `measured` when measured (s, of the application's clock)."""

    def __init__(self, path, type, published, measured, values):
        self.path = path
        self.type = type
        self.times = numpy.array(published, "i8") / 1e9
        self.measured = numpy.array(measured, "i8") / 1e9
        self.values = values

    def __len__(self):
        return len(self.times)

    def __repr__(self):
        return f"<{len(self)} values of {self.path}, {self.type}>"

    def __getitem__(self, field):
        """A field of all values as an array: series["x"], series["pose.x"]."""
        if isinstance(self.values, numpy.ndarray):
            found = self.values
            for each in field.split("."):
                found = found[each]
            return found
        found = list(self.values)
        for each in field.split("."):
            found = [value[each] for value in found]
        try:
            return numpy.array(found)
        except ValueError:  # lists of several lengths
            return found

    def frame(self):
        """A table of pandas: a row for each value, a column for each number in it ("pose.x"), by time in s."""
        import pandas

        columns = {}
        _flatten("", self.values, columns)
        frame = pandas.DataFrame(columns, index=pandas.Index(self.times, name="time"))
        frame.attrs = {"path": self.path, "type": self.type}
        return frame

    def plot(self, *fields, axes=None):
        """Draws fields over time with matplotlib, all numbers if none are named; see runnel.plot."""
        from runnel import plot

        return plot.series(self, *fields, axes=axes)


def _short(path):
    parts = path.strip("/").split("/")
    return "/" + "/".join(parts[1:-2] + parts[-1:])


def _flatten(name, values, columns):
    if isinstance(values, numpy.ndarray) and values.dtype.names:
        for each in values.dtype.names:
            _flatten(f"{name}.{each}" if name else each, values[each], columns)
        return
    first = values[0] if len(values) else None
    if isinstance(first, (dict, _extension.Value)):
        names = list(first) if isinstance(first, dict) else [each[0] for each in first.type.fields]
        if names:
            for each in names:
                _flatten(f"{name}.{each}" if name else each, [value[each] for value in values], columns)
            return
    if isinstance(values, numpy.ndarray) and values.ndim > 1:
        values = list(values)
    columns[name or "value"] = values
