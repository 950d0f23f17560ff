"""Both kinds of applications have each request that the table describes."""

import pathlib
import re

import pytest

import runnel

TABLE = pathlib.Path(__file__).parents[3] / "plugins" / "command_service" / "request_table.cpp"
# Called otherwise here, as these words mean something else in Python, or need a name of their own.
OTHERWISE = {"change": "apply", "speed": "set_speed", "log": "apply"}
# By ask("restart") of another process alone; in this one, whoever has loaded the application loads it again.
WITHOUT = {"restart"}


def names():
    return re.findall(r'DescribedRequest\{\s*"(\w+)"', TABLE.read_text())


def test_the_table_is_read():
    assert {"stop", "release", "publish", "pause", "set", "quit"} <= set(names())


@pytest.mark.parametrize("kind", [runnel.Application, runnel.Remote])
def test_each_request_has_a_method(kind):
    lacking = [name for name in names() if name not in WITHOUT and not hasattr(kind, OTHERWISE.get(name, name))]
    assert lacking == []
