"""Values and words as texts that Runnel reads."""

import numpy

from runnel import _extension


def text_of(value, inside=False):
    """The text format of a value.

    >>> text_of({"x": 1, "name": "a b", "list": [1.5, True]})
    '{x: 1, name: "a b", list: [1.5, true]}'
    """
    if isinstance(value, bool) or isinstance(value, numpy.bool_):
        return "true" if value else "false"
    if isinstance(value, str):
        if not inside:
            return value
        escaped = value.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n").replace("\t", "\\t").replace("\r", "\\r")
        return f'"{escaped}"'
    if isinstance(value, dict):
        return "{" + ", ".join(f"{name}: {text_of(each, True)}" for name, each in value.items()) + "}"
    if isinstance(value, numpy.ndarray):
        return text_of(value.tolist())
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(text_of(each, True) for each in value) + "]"
    if isinstance(value, (numpy.integer, numpy.floating)):
        return repr(value.item())
    return str(value) if isinstance(value, _extension.Value) else repr(value)


def quoted(text):
    """A word of a change or a request, whatever is in it."""
    return text_of(str(text), True)
