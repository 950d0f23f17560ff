"""Pictures with matplotlib, of recordings and of values."""

import numpy


def _axes(axes):
    if axes is not None:
        return axes
    from matplotlib import pyplot

    return pyplot.gca()


def series(recorded, *fields, axes=None):
    """Fields of a Series over time (s), all numbers if none are named. Returns the axes."""
    axes = _axes(axes)
    frame = recorded.frame()
    for name in fields or frame.select_dtypes("number").columns:
        axes.step(frame.index, frame[name], where="post", label=name)
    axes.set_xlabel("time in s")
    axes.set_title(recorded.path)
    axes.legend()
    return axes


def way(poses, axes=None, **options):
    """The way of poses (a Series, an array with x and y, or (x, y) columns) in metres."""
    axes = _axes(axes)
    x, y = (poses["x"], poses["y"]) if not isinstance(poses, tuple) else poses
    axes.plot(x, y, **options)
    axes.set_aspect("equal")
    axes.set_xlabel("x in m")
    axes.set_ylabel("y in m")
    return axes


def scan(value, pose=None, axes=None, **options):
    """The points that a RangeScan sees, from `pose` (x, y, heading) in metres."""
    axes = _axes(axes)
    ranges = numpy.asarray(value.ranges, float)
    angles = value.start_angle + value.angle_step * numpy.arange(len(ranges)) + (pose.heading if pose is not None else 0)
    hit = numpy.isfinite(ranges) & (ranges < value.range_maximum)
    x, y = (pose.x, pose.y) if pose is not None else (0.0, 0.0)
    axes.plot(x + (ranges * numpy.cos(angles))[hit], y + (ranges * numpy.sin(angles))[hit], ".", **options)
    axes.set_aspect("equal")
    return axes
