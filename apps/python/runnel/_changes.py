"""Changes of an application, in this process or in another, as texts, which the application reads."""

from runnel._text import quoted, text_of


def _type_text(type):
    # A module type by its name, or a class in Python.
    if isinstance(type, str):
        return type
    from runnel import _modules

    return _modules.type_of(type)


def _change(verb, /, *words, **options):
    for each in words:
        if not isinstance(each, str):
            raise TypeError(f"{each!r} is no text, as '{verb}' takes them")
    said = (f"{name}={quoted(text_of(value))}" for name, value in options.items())
    return " ".join([verb, *(quoted(each) for each in words), *said])


class Changes:
    """What there is to apply() and paths(): ways to say single changes."""

    def create(self, path, type, /, **parameters):
        """A module at `path`, of a type by name ("planning/bug2") or of a class in Python; makes the groups above."""
        groups, whole = self._groups_above(path)
        self.apply("\n".join([*groups, _change("create", whole, _type_text(type), **parameters)]))

    def group(self, path):
        """An empty group; makes those above."""
        groups, whole = self._groups_above(path)
        self.apply("\n".join([*groups, _change("create group", whole)]))

    def _groups_above(self, path):
        # Changes that make those that are not there yet, and the whole path.
        root = "/" + self.name
        whole = path if (path + "/").startswith(root + "/") else root + "/" + path.lstrip("/")
        parts = whole.split("/")
        wanted = ["/".join(parts[:i]) for i in range(3, len(parts))]
        there = {each for each, kind, _ in self.paths() if kind in ("group", "module")} if wanted else ()
        return [_change("create group", each) for each in wanted if each not in there], whole

    def connect(self, source, *sinks, queue=0, on_full=None, pull=False, late=False, convert=""):
        """Lets values flow from a port (or a part of its values, "/world/pose.x") to others.

        queue -- how many values may wait, 0: only the newest counts; on_full -- drop_oldest (usual), drop_newest or refuse.
        """
        options = {"queue": queue, "on_full": on_full, "pull": pull, "late": late, "convert": convert}
        for sink in sinks:
            self.apply(_change("connect", source, sink, **{name: each for name, each in options.items() if each}))

    def disconnect(self, source, sink):
        """Ends a connection."""
        self.apply(_change("disconnect", source, sink))

    def delete(self, path):
        """Deletes an element, with all below it."""
        self.apply(_change("delete", path))

    def thread(self, name, period=None, priority=0):
        """A thread container that runs every `period` (s), or, without, when data comes. The first runs what is assigned to none."""
        begins = {"activation": "trigger"} if period is None else {"period": f"{round(period * 1e9)}ns"}
        self.apply(_change("create thread", name, **begins, priority=priority))

    def assign(self, path, thread):
        """Has what is at or below `path` run by a thread; "" takes that back."""
        self.apply(f"{_change('move', path)} {_change('to', thread)}")

    def swap(self, path, type, /, **parameters):
        """Puts a module of another type, or of the same anew, in the place of one: connections, values, state go over."""
        self.apply(f"{_change('replace', path)} {_change('with', _type_text(type), **parameters)}")
