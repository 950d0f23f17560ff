"""What a module in Python takes over from the one before it, and what it has of its own."""

import sys

import pytest

import runnel

HOLD = '''
import functools
import weakref

import runnel


class Machine:
    def __init__(self, module):
        self.module = module


class Hold(runnel.Module):
    gain = runnel.Parameter(1.0)
    seen = runnel.Output("double[]")

    def __init__(self):
        self.steps = {"go": self.go}
        self.later = [functools.partial(self.go)]
        self.short = lambda: self.gain
        self.machine = Machine(self)
        self.state = self.begun
        self.private = self.__begun
        gone = Machine(None)
        self.proxy = weakref.proxy(gone)
        self.n = 0
        self.list = [0]
        self.same = self.list
        self.speed = 0.4
        self.goal = None
        self.limit = 3

    def __begun(self):
        return 0

    def __goes_on(self):
        return FACTOR

    def begun(self):
        self.state = self.goes_on
        return 0

    def goes_on(self):
        return FACTOR * self.gain

    def go(self):
        return FACTOR * self.gain

    def update(self):
        self.n += 1
        if self.n == 5:
            self.private = self.__goes_on
        self.list.append(self.n)
        self.seen.publish([self.steps["go"](), self.later[0](), self.short(), self.machine.module.go(), float(self.n),
                           float(self.list is self.same), self.state(), float(self.private())])
'''


@pytest.fixture
def app(empty_folder):
    (empty_folder / "hold.py").write_text(HOLD.replace("FACTOR", "1"))
    with runnel.compose("held", clock="simulated") as app:
        app.create("hold", "python/hold.Hold")
        app.run_for(1)
        yield app


def test_what_knows_the_module_before_is_not_handed_over(app, empty_folder):
    app["/hold/gain"] = 2.0
    app.swap("/hold", "python/hold.Hold")
    app["/hold/gain"] = 7.0
    app.run_for(0.1)
    go, later, short, machine, n, is_same, state, private = app.read("/hold/seen")
    assert [go, later, short, machine] == [7, 7, 7, 7]
    assert private == 1, "so does a private one"
    assert state == 7, "a method goes over as the one of the new module"
    assert n > 20 and is_same, "what it has counted goes over, and two names of one list are still that"
    (empty_folder / "hold.py").write_text(HOLD.replace("FACTOR", "10"))
    app.reload()
    app.run_for(0.1)
    assert [app.read("/hold/seen")[at] for at in (0, 1, 2, 3, 6)] == [70, 70, 7, 70, 70], "the code is that of the file as it is now"
    assert app.faults() == []


@pytest.mark.parametrize("old, new", [
    ("        self.speed = 0.4\n", "    speed = runnel.Parameter(0.7)\n"),
    ("        self.goal = None\n", '    goal = runnel.Input("double")\n'),
    ("        self.limit = 3\n", "    limit = property(lambda self: 5)\n"),
    ("        self.limit = 3\n", "    def limit(self):\n        return 5\n"),
])
def test_what_has_become_a_port_a_parameter_or_a_method_is_that_of_the_new_class(app, empty_folder, old, new):
    name = old.split(".")[1].split(" ")[0]
    text = HOLD.replace("FACTOR", "1").replace(old, "").replace("    def go(self)", f"{new}\n    def go(self)")
    text = text.replace("self.n += 1", f"self.n += 1\n        assert self.{name} not in (0.4, None, 3)")
    (empty_folder / "hold.py").write_text(text)
    app.swap("/hold", "python/hold.Hold")
    app.run_for(0.5)
    assert app.faults() == [] and app.read("/hold/seen")[4] > 20


OF_ITS_FILE = '''
import contextlib
import dataclasses
import enum

import runnel

FACTOR = VALUE


class Mode(enum.Enum):
    SEARCH = 1
    FOLLOW = 2


class Side(enum.Flag):
    LEFT = 1
    RIGHT = 2


class Status(enum.IntFlag):  # a device's, which has more bits than have names
    READY = 1


def law():
    return FACTOR


@dataclasses.dataclass
class Controller:
    sum: float = 0.0

    def output(self):
        return FACTOR

    @staticmethod
    def gain():
        return FACTOR


class Base(runnel.Module):
    seen = runnel.Output("double[]")

    @contextlib.contextmanager  # what it makes is a function of another file
    def opened(self):
        yield

    def __init__(self):
        self.mode = Mode.FOLLOW
        self.sides = Side.LEFT | Side.RIGHT
        self.status = Status(9)
        self.modes = {Mode.SEARCH: 5.0}
        self.law = law
        self.controller = Controller(7.0)
        self.kind = Controller
        self.output = self.controller.output
        self.outputs = [self.controller.output, Controller.gain]
        self.controller.own = self.controller.output

    def update(self):
        mine = [self.mode is Mode.FOLLOW, self.modes.get(Mode.SEARCH) == 5.0, self.controller == Controller(7.0), self.kind is Controller,
                Side.LEFT in self.sides, self.sides & Side.RIGHT == Side.RIGHT, self.output.__self__ is self.controller,
                self.status == 9, type(self.status) is Status]
        self.seen.publish([float(all(mine)), self.law(), self.controller.output(), self.output(), self.controller.own(),
                           *(each() for each in self.outputs)])


class Control(Base):
    pass
'''


@pytest.mark.parametrize("name", ["Base", "Control"])
def test_classes_functions_and_enumerations_of_the_file_are_those_of_the_file_as_it_is_now(empty_folder, name):
    (empty_folder / "of_its_file.py").write_text(OF_ITS_FILE.replace("VALUE", "1.0"))
    with runnel.compose("held", clock="simulated") as app:
        app.create("control", f"python/of_its_file.{name}")
        app.run_for(0.1)
        assert list(app.read("/control/seen")) == [1, 1, 1, 1, 1, 1, 1]
        (empty_folder / "of_its_file.py").write_text(OF_ITS_FILE.replace("VALUE", "2.0"))
        app.reload()
        app.run_for(0.1)
        assert list(app.read("/control/seen")) == [1, 2, 2, 2, 2, 2, 2]
        assert app.faults() == []


def test_a_file_that_was_edited_after_it_was_imported_is_made_anew(empty_folder, monkeypatch):
    text = 'import runnel\nclass Edited(runnel.Module):\n    seen = runnel.Output("double")\n    def update(self):\n        self.seen.publish(VALUE)\n'
    monkeypatch.setattr(sys, "dont_write_bytecode", False)
    monkeypatch.syspath_prepend(str(empty_folder))
    (empty_folder / "edited_file.py").write_text(text.replace("VALUE", "1.0"))
    module = __import__("edited_file")
    try:
        (empty_folder / "edited_file.py").write_text(text.replace("VALUE", "22.0"))
        with runnel.compose("edited", clock="simulated") as app:
            app.create("edited", module.Edited)
            app.reload()
            app.run_for(0.1)
            assert app.read("/edited/seen") == 22
    finally:
        sys.modules.pop("edited_file")


def test_an_attribute_does_not_hide_a_port(empty_folder):
    (empty_folder / "hiding.py").write_text(
        'import runnel\nclass Hiding(runnel.Module):\n    goal = runnel.Input("double")\n'
        '    def __init__(self):\n        self.goal = None\n    def update(self):\n        self.goal.read()\n')
    with runnel.compose("hidden", clock="simulated") as app:
        with pytest.raises(runnel.Error, match="'goal' is a port"):
            app.create("hiding", "python/hiding.Hiding")


def test_a_file_that_is_found_through_a_link_is_run_once(empty_folder, monkeypatch):
    (empty_folder / "real").mkdir()
    (empty_folder / "real/shared_by_link.py").write_text(
        "import runnel\nclass S(runnel.Module):\n    made = []\n    def update(self):\n        S.made.append(1)\n")
    (empty_folder / "folder").symlink_to(empty_folder / "real")
    (empty_folder / "installed").mkdir()
    (empty_folder / "installed/linked_file.py").symlink_to(empty_folder / "real/shared_by_link.py")
    for folder, name in (("folder", "shared_by_link"), ("installed", "linked_file")):
        monkeypatch.syspath_prepend(str(empty_folder / folder))
        module = __import__(name)
        try:
            with runnel.compose("shared", clock="simulated") as app:
                app.create("s", module.S)
                app.run_for(0.5)
            assert module.S.made, f"{name}: another class was made"
        finally:
            sys.modules.pop(name)


def test_the_second_application_of_a_process_loads_the_plugin_as_the_first_did(empty_folder):
    (empty_folder / "twice.py").write_text("import runnel\nclass Twice(runnel.Module):\n    def update(self):\n        pass\n")
    for _ in range(2):
        with runnel.compose("twice", clock="simulated") as app:
            app.create("twice", "python/twice.Twice")
            app.reload()
            app.save("twice.xml", overwrite=True)
        assert '<load plugin="python"/>' in (empty_folder / "twice.xml").read_text()
