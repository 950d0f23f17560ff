"""Services of modules in Python, and clients of services."""

import inspect

from runnel import _extension
from runnel._text import text_of

_NAMES = {bool: "bool", int: "int64", float: "double", str: "string"}


def _type_name(said, where):
    """The described type that an annotation means: a type of Python's, a runnel.Type, or a name."""
    if isinstance(said, str):
        try:
            said = eval(said, where)  # of who has annotations as texts
        except Exception:
            return said
    if said in _NAMES:
        return _NAMES[said]
    name = said if isinstance(said, str) else getattr(said, "name", None)
    if not isinstance(name, str):
        raise TypeError(f"{said!r} is no type of values: write bool, int, float, str, or the name of a described type")
    return name


def _arguments(said, where):
    """(names, types) of a client's arguments."""
    if said is None:
        return [], []
    if isinstance(said, dict):
        return list(said), [_type_name(each, where) for each in said.values()]
    return [], [_type_name(each, where) for each in (said if isinstance(said, (list, tuple)) else [said])]


class Service:
    """What a module does when it is asked: made by @runnel.service."""

    def __init__(self, handler, activity, queue, description):
        signature = inspect.signature(handler)
        given = list(signature.parameters.values())[2 if activity else 1:]
        where = handler.__globals__
        for each in given:
            if each.annotation is each.empty:
                raise TypeError(f"the service '{handler.__name__}' does not say of which type '{each.name}' is: "
                                f"{each.name}: float, or {each.name}: \"Pose2\"")
        reply = signature.return_annotation
        self.handler = handler
        self.__doc__ = handler.__doc__
        self.said = dict(
            reply="" if reply in (signature.empty, None, "None") else _type_name(reply, where),
            names=[each.name for each in given], types=[_type_name(each.annotation, where) for each in given],
            defaults={each.name: each.default for each in given if each.default is not each.empty},
            activity=activity, queue=queue, description=description or (inspect.getdoc(handler) or "").partition("\n")[0])

    def __set_name__(self, owner, name):
        self.name = name

    def __get__(self, instance, owner=None):
        return self if instance is None else self.handler.__get__(instance, owner)


def service(handler=None, *, activity=False, queue=16, description=""):
    """A method of a module that others can call: modules through a client, people by ``runnel call``.

        @runnel.service
        def drive_to(self, goal: "Point2", speed: float = 0.4) -> bool:

    Arguments and reply are described types, by name or as bool, int, float, str. It is served in the module's cycle, before
    update(); what it throws is the call's error. With activity=True a thread of the service's own serves one call at a time, and
    the first argument has report(fraction, doing) and is_abort_asked. queue -- how many calls may wait.
    """
    if handler is None:
        return lambda each: Service(each, activity, queue, description)
    return Service(handler, activity, queue, description)


class Client:
    """What a module asks others to do: ``arm = runnel.Client(bool, {"angle": float})``, connected to a service of these types.

    In update(): ``self.arm.send(angle=1)`` one way; ``self.arm.call(self.on_moved, angle=1)`` is called back in a cycle of this
    module; ``moving = self.arm.begin(angle=1)`` is looked at later. timeout -- s, on the application's clock; calls -- how
    many may be under way.
    """

    def __init__(self, reply=None, arguments=None, required=False, timeout=5.0, calls=16, description=""):
        where = inspect.currentframe().f_back.f_globals
        names, types = _arguments(arguments, where)
        self.said = dict(reply="" if reply is None else _type_name(reply, where), names=names, types=types, required=required,
                         timeout=float(timeout), calls=calls, description=description)

    def __set_name__(self, owner, name):
        self.name = name

    def __get__(self, instance, owner=None):
        return self if instance is None else instance._runnel_ports[self.name]


def described(service):
    """The same for the extension, with the defaults as text."""
    said = dict(service.said)
    if isinstance(service, Service):
        said["are_optional"] = len(said["defaults"]) == len(said["names"])
        said["defaults"] = text_of(said["defaults"]) if said["defaults"] else ""
    return said
