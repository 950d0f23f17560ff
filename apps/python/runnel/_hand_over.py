"""What a module in Python takes over from the one that was there before it."""

import enum
import functools
import gc
import importlib.util
import inspect
import operator
import types
import weakref

from runnel import _extension


def _own_copy():
    """Python's module `copy`, but one of our own that looks at what it remembers first, also for a class or a function: from Python
    3.14 on these are copied as what they are."""
    spec = importlib.util.find_spec("copy")
    own = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(own)
    plain = {type, types.FunctionType}
    own._atomic_types = getattr(own, "_atomic_types", set()) - plain
    own._deepcopy_dispatch.update(dict.fromkeys(plain, lambda each, notes: each))
    return own


_copy = _own_copy()


class _IsPort(Exception):
    pass


def _is_port(port, memo):
    raise _IsPort


for each in (_extension.ModuleInput, _extension.ModuleOutput, _extension.ModuleClient):
    each.__deepcopy__ = _is_port


def _methods_in(value, before):
    """The methods that can be got at by a value. None if the module before can: by a method of it, a function that knows it, an
    object that holds it."""
    met, ahead, methods = set(), [value], []
    while ahead:
        each = ahead.pop()
        kind = type(each)  # which isinstance() would ask a proxy for
        if each is before or each is before._runnel_host:
            return None
        if id(each) in met or issubclass(kind, (type, types.ModuleType)):
            continue
        met.add(id(each))
        if kind is types.MethodType:
            methods.append(each)
        if kind is types.FunctionType:  # without all else that its file has
            ahead += [each.__closure__, each.__defaults__, each.__kwdefaults__]
        elif issubclass(kind, weakref.ref):
            ahead.append(each())
        elif gc.is_tracked(each):
            ahead += gc.get_referents(each)
    return methods


class _Notes(dict):
    """What a copy remembers. Methods of what it copies are those of the classes as they are now: copy.deepcopy() keeps their functions."""

    def __init__(self, known, methods):
        super().__init__(known)
        self._methods = {id(each): each for each in methods}

    def get(self, key, default=None):
        method = None if key in self else self._methods.get(key)
        if method is None:
            return super().get(key, default)
        function = super().get(id(method.__func__), method.__func__)
        self[key] = types.MethodType(function, _copy.deepcopy(method.__self__, self))
        return self[key]


def _file_of(module):
    """What the file has that a module's class stands in. Not by the name of the file, as the one before has the same."""
    name = type(module).__module__
    own = (each for cls in type(module).__mro__ if cls.__module__ == name for each in vars(cls).values())
    functions = (inspect.unwrap(each) for each in own if isinstance(each, types.FunctionType))  # a decorator's is of another file
    files = (getattr(each, "__globals__", {}) for each in functions)
    return next((each for each in files if each.get("__name__") == name), {})


def _plain(member):
    """The function that is within a static method, which is what others get by its name, or within a method of the class."""
    return member.__func__ if isinstance(member, (staticmethod, classmethod)) else member


def _members(old, new):
    """Members of an enumeration with those that they are now, by their names; combinations of flags by those of what is combined."""
    for each in [*old.__members__.values(), *old._value2member_map_.values()]:
        if each.name in new.__members__:
            yield each, new[each.name]
        elif issubclass(old, enum.Flag) and issubclass(new, enum.Flag):
            parts = [one for one in old if one in each]
            nameless = each.value & ~functools.reduce(operator.or_, (one.value for one in parts), 0)
            if not all(one.name in new.__members__ for one in parts):
                continue
            try:
                rest = new(nameless)
            except ValueError:  # it has only named ones now
                continue
            yield each, functools.reduce(operator.or_, (new[one.name] for one in parts), rest)


def _add_successors(memo, before, after):
    """Has copies use the classes, functions and members of enumerations of a file as it is now instead of those that it had."""
    for name, old in list(before.items()):
        old, new = _plain(old), _plain(after.get(name))
        if new is old or not isinstance(old, (type, types.FunctionType)) or not isinstance(new, type(old)) or id(old) in memo:
            continue
        if old.__module__ != new.__module__ or old.__qualname__ != new.__qualname__:  # what both import
            continue
        memo[id(old)] = new
        if isinstance(old, enum.EnumMeta):
            memo |= {id(each): member for each, member in _members(old, new)}
        if isinstance(old, type):
            _add_successors(memo, vars(old), vars(new))


def _attribute_of(method):
    """The name by which an object has a method: a private one has that of its class before its own."""
    name = getattr(method, "__name__", "")  # which functools.partial() has not
    if not name.startswith("__") or name.endswith("__") or "." not in method.__qualname__:
        return name
    return f"_{method.__qualname__.split('.')[-2].lstrip('_')}{name}"


def take_over(module, before):
    """The attributes of the module that was there before; copies, as it may come back. What leads to that module, has its ports, or is
    described by the class (a port, a parameter, a method) is that of the new one: else it would go on with the old one, and its code."""
    copied = {id(module): module}
    _add_successors(copied, _file_of(before), _file_of(module))
    begun = []  # kept to the end, as a copy remembers the address of what it is noted in
    for name, value in vars(before).items():
        described = hasattr(type(getattr(type(module), name, None)), "__get__") or name in module._runnel_ports
        if type(value) is types.MethodType and value.__self__ is before:  # the state that it is in, say
            value = getattr(module, _attribute_of(value), value)
        methods = None if name.startswith("_runnel_") or described else _methods_in(value, before)
        if methods is None:
            continue
        try:
            done = _Notes(copied, methods)  # without what a copy that fails has begun
            begun.append(done)
            value = _copy.deepcopy(value, done)
            copied = done
        except _IsPort:
            continue
        except Exception:  # a file, a thread: there is one only, and both have it
            pass
        setattr(module, name, value)
