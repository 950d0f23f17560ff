"""Runnel in Python: applications of robots loaded, composed, run, watched and changed.

>>> app = runnel.compose("demo", clock="simulated")
>>> app.create("world", "simulation/world", world="rooms")
>>> app.step(3)
>>> app.read("/world/goal").type
<type Point2>

Units are SI throughout: metres, radians (counter-clockwise), seconds. Errors are `runnel.Error`, with file, line, path
and the nearest name that there is.
"""

from runnel._extension import Error, Reader, Type, Value, Writer, make, version as __version__
from runnel._modules import Input, Module, Output, Parameter, StaticParameter
from runnel._services import Client, service
from runnel._types import image, types
from runnel.application import Application, Event, LogEntry, compose, load, load_text, replay

__all__ = [
    "Application", "Client", "Error", "Event", "Input", "LogEntry", "Module", "Output", "Parameter", "Reader",
    "StaticParameter", "Type", "Value", "Writer", "compose", "image", "load", "load_text", "make", "replay", "service", "types",
]


def __getattr__(name):
    # What few scripts need is imported when it is asked for.
    import importlib

    homes = {"connect": "remote", "applications": "remote", "Remote": "remote", "read": "recordings",
             "Recording": "recordings", "arena": None, "plot": None}
    if name not in homes:
        raise AttributeError(f"module 'runnel' has no attribute '{name}'")
    home = homes[name]
    if home is None:
        return importlib.import_module("runnel." + name)
    return getattr(importlib.import_module("runnel." + home), name)
