"""Modules in Python: `runnel.Module` and its ports and parameters, and how files with them are found."""

import difflib
import hashlib
import importlib.util
import linecache
import os
import pathlib
import sys
import traceback
import types

from runnel import _extension
from runnel._hand_over import take_over  # noqa: F401, called by the extension
from runnel._services import Client, Service, described

_class = type  # which arguments are called, too

class _Described:
    def __set_name__(self, owner, name):
        self.name = name

    def __set__(self, instance, value):
        raise AttributeError(f"'{self.name}' is a port: an attribute would hide it")


class Input(_Described):
    """An input of a module, by the name of its type: ``scan = runnel.Input("RangeScan")``.

    required -- an application in which nothing is connected is wrong; trigger -- what a module without a period waits for;
    set_once -- a goal, a map, a mode, which holds until there is another: without it, what update() publishes is as old as what it
    has read here, so that a silent sensor is seen at the wheels, and an older value than timeout (s) is None for read() and new().
    The module has a parameter ``scan_timeout`` for that, which the file may set, unless the class has one of that name itself.
    """

    def __init__(self, type, required=False, trigger=False, unit="", description="", set_once=False, timeout=0.5):
        self.said = dict(type=_name(type), required=required, trigger=trigger, unit=unit, description=description,
                         set_once=set_once, timeout=float(timeout))

    def __get__(self, instance, owner=None):
        return self if instance is None else instance._runnel_ports[self.name]


class Output(_Described):
    """An output of a module, by the name of its type: ``twist = runnel.Output("Twist2")``."""

    def __init__(self, type, unit="", description=""):
        self.said = dict(type=_name(type), unit=unit, description=description)

    def __get__(self, instance, owner=None):
        return self if instance is None else instance._runnel_ports[self.name]


class Parameter(_Described):
    """A parameter of a module, of the type of its default: bool, int, float, str or a list of numbers.

    ``speed = runnel.Parameter(0.4, unit="m/s", bounds=(0, 1))``; in update() ``self.speed`` is its value.
    """

    def __init__(self, default, unit="", bounds=(None, None), description=""):
        kinds = {bool: "bool", int: "int", float: "float", str: "str", list: "list", tuple: "list"}
        kind = kinds.get(type(default))
        if kind is None:
            raise TypeError(f"a parameter is a bool, int, float, str or a list of numbers, not {default!r}")
        if kind in ("bool", "str", "list") and tuple(bounds) != (None, None):
            raise TypeError("only numbers have bounds")
        self.said = dict(kind=kind, default=list(default) if kind == "list" else default, unit=unit, lowest=bounds[0],
                         highest=bounds[1], description=description)

    def __get__(self, instance, owner=None):
        return self if instance is None else instance._runnel_host.parameter(instance._runnel_parameters[self.name])

    def __set__(self, instance, value):
        raise AttributeError(f"'{self.name}' is a parameter: it is set from outside, in the file or by set()")


class StaticParameter(Parameter):
    """A parameter that is settled before the module has its ports: by its value make_ports() says which there are."""

    def __init__(self, default, unit="", bounds=(None, None), description=""):
        super().__init__(default, unit, bounds, description)
        self.said["is_static"] = True


class Module:
    """A module in Python: ports and parameters are class attributes, and update() is called in each cycle.

        class Follower(runnel.Module):
            period = 0.05
            scan = runnel.Input("RangeScan")
            twist = runnel.Output("Twist2")
            speed = runnel.Parameter(0.4, unit="m/s", bounds=(0, 1))

            def update(self):
                scan = self.scan.new()
                if scan is not None:
                    self.twist.publish(forward=self.speed if scan.ranges.min() > 0.5 else 0.0)

    period -- of the thread of its own, in s; None: it runs when data comes to an input with trigger=True. A module that is
    assigned to another thread runs there. What it keeps in attributes a module in its place takes over. __init__() has no
    effect on the world, as tools make modules to list their ports; files are opened in prepare().
    """

    period = 0.05

    def update(self):
        """Called in each cycle. What it throws is a fault, by which this module alone fails."""
        raise NotImplementedError("update() is missing")

    def make_ports(self):
        """Ports and clients beside those of the class, by name: ``{f"in{i}": runnel.Input("double") for i in range(self.count)}``.

        Called once, when static parameters are set, before __init__(). They are attributes, too: ``getattr(self, f"in{i}")``.
        """
        return {}

    def __getattr__(self, name):
        try:
            return self.__dict__["_runnel_ports"][name]
        except KeyError:
            raise AttributeError(f"'{_class(self).__name__}' has no '{name}'") from None

    def prepare(self):
        """Called once, when parameters are set and before the first cycle."""

    @property
    def path(self):
        """Where the module is in the application."""
        return self._runnel_path

    @property
    def now(self):
        """The time of the cycle, in s on the application's clock."""
        return self._runnel_host.now()

    @property
    def cycle_period(self):
        """Planned time from cycle to cycle, in s; 0 without a plan."""
        return self._runnel_host.period()

    def log(self, text, level="info"):
        """Says something to people: level is debug, info, warning or error."""
        if level not in ("debug", "info", "warning", "error"):
            raise ValueError(f"there is no level '{level}'")
        self._runnel_host.say(level, str(text))


def _name(type):
    return type if isinstance(type, str) else type.name


def _members(cls, kind):
    found = {}
    for each in reversed(cls.__mro__):
        found |= {name: member for name, member in vars(each).items() if isinstance(member, kind)}
    return found


def type_of(cls):
    """The name of the module type that a class is; errors if nobody could find it again."""
    if not (isinstance(cls, type) and issubclass(cls, Module)):
        raise TypeError(f"a type of modules is a name or a class below runnel.Module, not {cls!r}")
    return f"python/{cls.__module__}.{cls.__qualname__}"


# What follows is called by the extension.


def parameters_of(cls):
    """Those of a class, for the extension."""
    return {name: member.said for name, member in _members(cls, Parameter).items()}


def make(cls, host, path):
    """An object of the class, tied to its module in C++, which has its parameters."""
    module = cls.__new__(cls)
    module._runnel_host = host
    module._runnel_path = path
    module._runnel_parameters = {name: index for index, name in enumerate(_members(cls, Parameter))}
    module._runnel_ports = {}
    return module


def ports_of(module):
    """What the extension is to make: kind -> name -> what is said of it."""
    cls = _class(module)
    made = module.make_ports()
    wrong = [name for name, each in made.items() if not isinstance(each, (Input, Output, Client))]
    if wrong:
        raise TypeError(f"make_ports() has '{wrong[0]}', which is no Input, Output or Client")
    taken = [name for name in made if hasattr(cls, name)]
    if taken:
        raise ValueError(f"make_ports() has '{taken[0]}', which the class has, too")
    ports = {}
    for kind, what in (("inputs", Input), ("outputs", Output), ("clients", Client), ("services", Service)):
        all_ports = _members(cls, what) | {name: each for name, each in made.items() if isinstance(each, what)}
        ports[kind] = {name: described(each) for name, each in all_ports.items()}
    return ports


def begin(module, ports):
    """Its ports have been made."""
    host = module._runnel_host
    for kind, bound in (("inputs", host.input), ("outputs", host.output), ("clients", host.client)):
        module._runnel_ports |= {name: bound(index) for index, name in enumerate(ports[kind])}
    module.__init__()


_loaded = {}  # file -> (digest of what was in it, module)


def _is_as_imported(module, file):
    """Whether a file still is what Python imported, by what is noted of it in its compiled form; true where there is none."""
    try:
        with open(module.__cached__, "rb") as compiled:
            head = compiled.read(16)
    except (AttributeError, OSError, TypeError):
        return True
    now = file.stat()
    words = [int(now.st_mtime), now.st_size]
    return head[4:8] != bytes(4) or head[8:] == b"".join((each & 0xFFFFFFFF).to_bytes(4, "little") for each in words)


def _load(file, name):
    digest = hashlib.sha256(file.read_bytes()).digest()
    known = _loaded.get(file)
    if known is not None and known[0] == digest:
        return known[1]
    imported = sys.modules.get(name)
    own = getattr(imported, "__file__", None)
    if known is None and own and os.path.realpath(own) == os.path.realpath(file):  # its folder or itself may be a link
        # By who composes the application: its classes are meant, until the file is looked at the next time.
        _loaded[file] = (digest if _is_as_imported(imported, file) else b"", imported)
        return imported
    linecache.checkcache(str(file))
    # From the text, for what Python keeps compiled goes by the second in which a file was written.
    code = compile(file.read_bytes(), str(file), "exec")
    module = importlib.util.module_from_spec(importlib.util.spec_from_file_location(name, file))
    if imported is None or any(imported is each for _, each in _loaded.values()):
        sys.modules[name] = module  # where pickle looks for its classes; what others have imported stays
    try:
        exec(code, module.__dict__)
    except BaseException:
        if sys.modules.get(name) is module:
            del sys.modules[name]
            if imported is not None:
                sys.modules[name] = imported
        raise
    _loaded[file] = (digest, module)
    return module


def _folders(folder):
    said = [folder] + os.environ.get("RUNNEL_PYTHON_PATH", "").split(os.pathsep) + [os.getcwd()] + sys.path
    return [pathlib.Path(each).resolve() for each in dict.fromkeys(said) if each]


def find_class(type, folder):
    """The class of "python/my_file.MyModule", its file as it is now; looked for beside the application's file first."""
    module_name, dot, class_name = type.partition("/")[2].rpartition(".")
    if not dot or not module_name:
        raise _extension.Error(f"'{type}' is no type of modules in Python; write python/FILE.CLASS")
    module = None
    for each in _folders(folder):
        file = each.joinpath(*module_name.split(".")).with_suffix(".py")
        if file.is_file():
            module = _load(file, module_name)
            break
    if module is None:
        module = sys.modules.get(module_name)
    if module is None:
        there = [each.stem for at in _folders(folder)[:3] for each in at.glob("*.py")]
        near = difflib.get_close_matches(module_name, there, 1)
        hint = f"did you mean '{near[0]}'?" if near else f"looked for in {_folders(folder)[0]}, $RUNNEL_PYTHON_PATH, and where Python does"
        raise _placed(f"there is no file {module_name}.py", hint=hint)
    found = vars(module).get(class_name)
    if not (isinstance(found, _class) and issubclass(found, Module)):
        there = [name for name, each in vars(module).items() if isinstance(each, _class) and issubclass(each, Module) and each is not Module]
        near = difflib.get_close_matches(class_name, there, 1)
        hint = f"did you mean '{near[0]}'?" if near else f"there is {', '.join(there) or 'none'}"
        raise _placed(f"there is no class '{class_name}' below runnel.Module in {getattr(module, '__file__', module_name)}", hint=hint)
    return found


def _placed(message, file="", line=0, hint=""):
    error = _extension.Error(message)
    error.message, error.file, error.line, error.hint = message, str(file), line, hint
    return error


def end_child(error):
    """A child that was forked in update(), a service or a callback ends where that does."""
    code = error.code if isinstance(error, SystemExit) else None
    if error is not None and not isinstance(error, SystemExit):
        traceback.print_exception(error)
        code = 1
    elif code is not None and not isinstance(code, int):  # a text, as Python has it
        print(code, file=sys.stderr)
        code = 1
    for each in sys.stdout, sys.stderr:
        try:
            each.flush()
        except Exception:  # there is none, or nobody reads it any more
            pass
    os._exit((code or 0) & 0xFF)


def _as_utf8(text):
    # Half a surrogate pair is text in Python, and in no log.
    return text.encode("utf-8", "backslashreplace").decode()


def _text_of(thrown):
    try:
        said = str(thrown)
    except Exception:
        said = "<its __str__ throws, too>"
    return _as_utf8(f"{type(thrown).__name__}: {said}")


def error_of(thrown, trace):
    """(message, file, line, hint) of what was thrown while a module was made."""
    if isinstance(thrown, _extension.Error):
        return thrown.message or str(thrown), thrown.file, thrown.line, thrown.hint
    if isinstance(thrown, SyntaxError):
        return f"{type(thrown).__name__}: {thrown.msg}", thrown.filename or "", thrown.lineno or 0, ""
    frames = traceback.extract_tb(trace)
    own = [each for each in frames if not each.filename.startswith(os.path.dirname(__file__))] or frames
    text = _text_of(thrown)
    return (text, own[-1].filename, own[-1].lineno or 0, "") if own else (text, "", 0, "")


def fault_of(thrown, trace):
    """What a fault says: the exception, and from where to where, the innermost first; and the whole traceback."""
    frames = traceback.extract_tb(trace)
    text = _text_of(thrown)
    for frame in reversed(frames):
        text += f"; {os.path.basename(frame.filename)}:{frame.lineno}, in {frame.name}: {frame.line}"
    return _as_utf8(text)[:490], _as_utf8("".join(traceback.format_exception(_class(thrown), thrown, trace)))[:3900]
