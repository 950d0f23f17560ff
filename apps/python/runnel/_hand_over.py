"""What a module in Python takes over from the one that was there before it."""

import copy
import enum
import gc
import types
import weakref

from runnel import _extension


class _IsPort(Exception):
    pass


def _is_port(port, memo):
    raise _IsPort


for each in (_extension.ModuleInput, _extension.ModuleOutput, _extension.ModuleClient):
    each.__deepcopy__ = _is_port


def _leads_to(value, before):
    """Whether the module before can be got at by a value: a method of it, a function that knows it, an object that holds it."""
    met, ahead = set(), [value]
    while ahead:
        each = ahead.pop()
        kind = type(each)  # which isinstance() would ask a proxy for
        if each is before or each is before._runnel_host:
            return True
        if id(each) in met or issubclass(kind, (type, types.ModuleType)):
            continue
        met.add(id(each))
        if kind is types.FunctionType:  # without all else that its file has
            ahead += [each.__closure__, each.__defaults__, each.__kwdefaults__]
        elif issubclass(kind, weakref.ref):
            ahead.append(each())
        elif gc.is_tracked(each):
            ahead += gc.get_referents(each)
    return False


def _file_of(module):
    """What the file has that a module's class stands in. Not by the name of the file, as the one before has the same."""
    own = (each for cls in type(module).__mro__ if cls.__module__ == type(module).__module__ for each in vars(cls).values())
    return next((each.__globals__ for each in own if isinstance(each, types.FunctionType)), {})


def _add_successors(memo, before, after):
    """Has copies use the classes, functions and members of enumerations of a file as it is now instead of those that it had."""
    for name, old in list(before.items()):
        new = after.get(name)
        if new is old or not isinstance(old, (type, types.FunctionType)) or not isinstance(new, type(old)) or id(old) in memo:
            continue
        if old.__module__ != new.__module__ or old.__qualname__ != new.__qualname__:  # what both import
            continue
        memo[id(old)] = new
        if isinstance(old, enum.EnumMeta):
            memo |= {id(each): new[each.name] for each in old if each.name in new.__members__}
        if isinstance(old, type):
            _add_successors(memo, vars(old), vars(new))


def _attribute_of(method):
    """The name by which an object has a method: a private one has that of its class before its own."""
    name = method.__name__
    if not name.startswith("__") or name.endswith("__"):
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
        if name.startswith("_runnel_") or described or _leads_to(value, before):
            continue
        try:
            done = dict(copied)  # without what a copy that fails has begun
            begun.append(done)
            value = copy.deepcopy(value, done)
            copied = done
        except _IsPort:
            continue
        except Exception:  # a file, a thread: there is one only, and both have it
            pass
        setattr(module, name, value)
