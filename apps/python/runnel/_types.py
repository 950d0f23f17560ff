"""`runnel.types`, and pictures as arrays."""

import numpy

from runnel import _extension


class _Types:
    """All described types by their names: ``runnel.types.Pose2(x=1, y=2)``, ``runnel.types["double[]"]([1, 2])``.

    A type that no module in this process has used yet is looked for in the manifests of the installed plugins.
    """

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return _extension.type_named(name)

    def __getitem__(self, name):
        return _extension.type_named(name)

    def __dir__(self):
        return [each for each in _extension.known_types() if each.isidentifier()]


types = _Types()

_CHANNELS = {"mono8": (1, "u1"), "8UC1": (1, "u1"), "mono16": (1, "u2"), "16UC1": (1, "u2"), "rgb8": (3, "u1"), "bgr8": (3, "u1"),
             "8UC3": (3, "u1"), "rgba8": (4, "u1"), "bgra8": (4, "u1"), "8UC4": (4, "u1"), "32FC1": (1, "f4")}


def image(value):
    """A picture as an array (height, width, channels), or (height, width) of one channel, that looks at `value`.

    Nothing is copied: the array keeps the lease of the buffer in which the camera has published it.
    """
    channels, kind = _CHANNELS.get(value.encoding, (None, None))
    if channels is None:
        raise ValueError(f"no array is known for pictures of encoding '{value.encoding}'; there is {', '.join(_CHANNELS)}")
    item = numpy.dtype(kind)
    shape = (value.height, value.width) + ((channels,) if channels > 1 else ())
    strides = (value.row_stride, channels * item.itemsize) + ((item.itemsize,) if channels > 1 else ())
    flat = value.data
    if value.height and (value.height - 1) * value.row_stride + value.width * channels * item.itemsize > flat.nbytes:
        raise ValueError(f"the picture has {flat.nbytes} bytes, too few for {value.width} x {value.height} {value.encoding}")
    return numpy.ndarray(shape, item, flat, strides=strides)


def restore(name, plain):
    """What pickle calls."""
    return _extension.make(name, plain)
