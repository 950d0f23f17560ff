"""`runnel.Application`: an application in this process."""

import asyncio
import atexit
import os
import pathlib
import signal
import traceback
import weakref
from typing import NamedTuple

from runnel import _extension
from runnel._changes import Changes
from runnel._text import text_of

_open = weakref.WeakValueDictionary()  # by their ids; valuerefs() may be asked for while others open and close


_is_ending = False


@atexit.register
def _end():
    # No cycle of a module in Python may run, and no thread may want the interpreter, when it goes.
    global _is_ending
    _is_ending = True
    while True:
        try:
            return _close_all()
        except BaseException:  # of a signal's handler
            signal.signal(signal.SIGINT, signal.SIG_DFL)  # the next one ends the process at once, as that of `runnel run`


def _close_all():
    while _open:  # some may just have been loaded
        for each in _open.valuerefs():
            if (app := each()) is None:
                continue
            try:
                app.close()
            except Exception:
                traceback.print_exc()
            _open.pop(id(app), None)
    _extension.await_all()


def _leave_all():
    # Threads are not forked: what waits for them would wait for ever.
    _extension.forked()
    for each in _open.valuerefs():
        if (app := each()) is not None:
            app._leave()


os.register_at_fork(after_in_child=_leave_all)


class Event(NamedTuple):
    """Something that has happened to an application: kind is warning, fault, notice, failure or message."""

    kind: str
    path: str
    message: str
    text: str


class LogEntry(NamedTuple):
    """An entry of the log; time in s on the application's clock."""

    time: float
    kind: str
    path: str
    text: str


KINDS = ("group", "module", "input", "output", "service", "parameter")  # of paths


def check_kind(kind, kinds=KINDS):
    if kind is not None and kind not in kinds:
        raise ValueError(f"there is no kind '{kind}'; there is {', '.join(kinds)}")


def _given(path):
    """The path, or None for all; what is empty by mistake is not all."""
    if path == "":
        raise _extension.Error("the path is empty")
    return path


_STOP = object()  # what is not said: a variable that is None by mistake must not end the STOP


def _port(path):
    """A path, and neither None nor the terminal's word for the STOP."""
    if path is None or path == "stop":
        raise _extension.Error(f"{path!r} is no port; release() without a path ends the STOP")
    return path


def _words(values):
    return [(str(name), text_of(value)) for name, value in values.items()]


def _options(settings=None, clock="", speed=None, paused=False, control=False, configurations=(), plugin_folders=(),
             record=None, record_ports=(), extensions=None):
    if clock and clock not in ("real", "simulated"):
        raise _extension.Error(f"there is no clock '{clock}'; there is 'real', 'simulated'")
    wanted = {name: list(options.items()) for name, options in (extensions or {}).items()}
    if record is not None:
        wanted["recording"] = [("record", str(record))] + [("record-ports", each) for each in record_ports]
    return (_words(settings or {}), [str(each) for each in configurations], [str(each) for each in plugin_folders], clock or "",
            speed, paused, control, list(wanted.items()))


def _meant(file):
    """The file, or that of an application that comes with Runnel, by its name alone."""
    path = pathlib.Path(file)
    if len(path.parts) != 1 or path.exists():
        return str(file)
    folders = pathlib.Path(_extension.__file__).resolve().parents
    shipped = (each / "share/runnel/xml/apps" / f"{path.stem}.xml" for each in folders)
    return str(next((each for each in shipped if each.is_file()), file))


def load(file, **options):
    """Loads an application file, or one that comes with Runnel by its name ("bug_demo"), ready to run. Nothing runs yet.

    settings -- {"goal_x": 4}, for parameters that name a `command_line`; clock -- "real" or "simulated", instead of what
    the file says; speed -- how many times faster than real time, 0: as fast as it can; paused -- begins with a pause;
    control -- others reach it by `runnel ls` and `runnel.connect`, and its STOP outlives this process (not that of load_text()
    and compose(), which have no file by which the next process would know them); record, record_ports -- into an MCAP file;
    extensions -- {"viewers": {"inspect": "8765"}}, as the options of `runnel run`.
    """
    return Application("file", _meant(file), "", *_options(**options))


def load_text(text, folder="", **options):
    """The same of a text; relative names of files in it start in `folder`."""
    return Application("text", text, str(folder), *_options(**options))


def compose(name, **options):
    """An empty application, to be composed by create(), connect() and thread(). Options as load()."""
    return Application("compose", name, "", *_options(**options))


def replay(recording, file, ports=(), begin=None, end=None, **options):
    """The application of `file`, in which what was recorded is published again in the place of what was recorded.

    ports -- patterns of those that are played ("/laser/*"), none: all; begin, end -- s since the recording's start.
    """
    words = {"recording": str(recording)}
    words |= {"from": repr(float(begin))} if begin is not None else {}
    words |= {"to": repr(float(end))} if end is not None else {}
    arguments = _options(**options)
    arguments[-1].append(("recording", list(words.items()) + [("ports", each) for each in ports]))
    return Application("file", _meant(file), "", *arguments)


class Application(_extension.Application, Changes):
    """A running application: made by load(), load_text(), compose() or replay().

    Paths may leave out the name of the application, and of ports and parameters the group: ``/robot/planner/twist``.
    Changes are made between two cycles, all of a change or nothing. Threads: any; what runs it, one at a time.

    >>> with runnel.load(xml / "apps/bug_demo.xml", clock="simulated", speed=0) as app:
    ...     app.run_for(2)
    ...     app["/robot/planner/cruise_speed"] = 0.3
    ...     app["/world/pose"].type
    <type Pose2>
    """

    def __init__(self, *arguments):
        if _is_ending:
            raise _extension.Error("the interpreter ends")
        super().__init__(*arguments)
        self._readers = {}
        _open[id(self)] = self

    def __enter__(self):
        return self

    def __exit__(self, *unused):
        self.close()

    def __repr__(self):
        try:
            return f"<runnel.Application {self.name}{', running' if self.is_running else ''}>"
        except (ValueError, RuntimeError, _extension.Error):  # RuntimeError: it has not been loaded
            return "<runnel.Application, closed>"

    def close(self):
        """Ends the run, finishes recordings, and lets go of everything. What was read stays valid. Idempotent.

        Waits for calls under way in other threads; those that wait or run cycles end, and raise, as do all later ones. Ctrl-C
        ends the wait alone. Raises in update() and other parts of a module, and in a signal handler that comes in a call: quit() ends that.
        """
        self._close()
        self._readers.clear()

    # Changing it, beside the methods of Changes.

    def delete(self, path):
        """Deletes an element, with all below it."""
        self._readers.clear()  # what undo() would look for
        super().delete(path)

    def apply(self, text):
        """Changes as text, all or none: "connect /a/out /b/in; set /b/gain 2"."""
        self._apply(text)

    def undo(self):
        """Takes the last change back."""
        self._undo()

    def redo(self):
        """Makes the change again that was taken back last."""
        self._redo()

    def reload(self, plugin="python"):
        """Loads a plugin anew, and makes its modules anew; "python": the files of all modules in Python."""
        self._reload(plugin)

    def save(self, file="", overwrite=False):
        """Saves what it is now to the file; "": the one that it came from."""
        self._save(os.path.abspath(file) if file else "", overwrite)

    # Values.

    def set(self, path, value):
        """Sets a parameter."""
        self._set(path, text_of(value))

    def get(self, path):
        """The value of a parameter."""
        return self._get(path)

    def read(self, path):
        """The newest value of a port; None if there is none yet. Not copied, but for inputs."""
        reader = self._kept(path)
        if reader is None:
            reader = self._read_input(path)
            if not isinstance(reader, _extension.Reader):
                return reader
            self._readers[path] = reader
        return reader.read()

    def _kept(self, path):
        # Names may mean others now: anybody can rename and delete. It stays: who takes a deletion back connects it again.
        reader = self._readers.get(path)
        return reader if reader is not None and reader._is_at(path) else None

    def __getitem__(self, path):
        """A parameter's value, or a port's newest."""
        reader = self._kept(path)
        if reader is not None:
            return reader.read()
        try:
            return self._get(path)
        except _extension.Error as no_parameter:
            try:
                return self.read(path)
            except _extension.Error as no_port:
                raise (no_port if "did you mean" in no_port.hint else no_parameter) from None

    def __setitem__(self, path, value):
        self.set(path, value)

    def reader(self, path, queue=0):
        """A Reader of a port, with a queue of each of its values."""
        return self._reader(path, queue)

    def writer(self, path):
        """A Writer, connected to an input."""
        return self._writer(path)

    def publish(self, path, value):
        """Sets the value at a port by hand: readers find it instead of what is published, until release()."""
        self._publish(path, value)

    def stop(self):
        """STOP of the robot: all that moves something has its safe value, until release(). At once, whatever else goes on.
        With load(…, control=True) it outlives this process, and returns when that is so. It raises also where STOP is in force and
        nothing is marked as driving, or the next process would not know of it yet.
        """
        self._robot_stop(True)

    def release(self, path=_STOP):
        """Ends the STOP; with the path of a port, its block and the value set by hand there. None is no path, and refused."""
        if path is _STOP:
            self._robot_stop(False)
        else:
            self._release(_given(_port(path)))

    def block(self, path):
        """Stops one port: its readers have the safe value, whatever anybody publishes, until release(path)."""
        self._block(path)

    def call(self, path, *argument, timeout=30.0, **arguments):
        """Calls a service with its arguments by name, and returns its reply. While nothing runs on simulated time, cycles are
        run until it has answered. timeout -- s, on the application's clock.
        """
        return self._call(path, timeout, *argument, **arguments)

    async def values(self, path, queue=128):
        """Each value of a port, as it comes: ``async for twist in app.values("/robot/planner/twist")``."""
        reader = self.reader(path, queue)
        loop = asyncio.get_running_loop()
        while True:
            for value in reader:
                yield value
            await loop.run_in_executor(None, reader.wait, 0.2)

    def record(self, file, ports=(), compression=""):
        """Records ports (patterns: "/robot/**"; none: all) from now on: ``with app.record("run.mcap"): app.run_for(5)``.

        compression -- zstd, lz4 or none; "": the first that is there.
        """
        return _extension.RunningRecording(self, os.path.abspath(file), list(ports), compression)

    def paths(self, kind=None):
        """(path, kind, type) of all groups, modules, inputs, outputs, services and parameters, or of those of one kind."""
        check_kind(kind)
        return [each for each in self._paths() if kind is None or each[1] == kind]

    # Running it.

    def run(self, limit=None):
        """Runs in this thread until its verdict, a fault rule or `limit` (s on its clock); how long it ran (s)."""
        return self._run(limit)

    def run_for(self, seconds):
        """Simulated time: all cycles that are due in the next `seconds` of its clock."""
        self._run_for(seconds)

    def step(self, cycles=1):
        """Simulated time: so many cycles, each the one that is due next."""
        self._step(cycles)

    def start(self):
        """Lets it run in threads of its own, until quit()."""
        self._start()

    def quit(self):
        """Ends all cycles, and the call that runs them. It can be started again. (The STOP of the robot is stop().)"""
        self._quit()

    def pause(self, path=None):
        """Pauses simulated time, or leaves what is at or below `path` out of cycles."""
        self._pause(_given(path))

    def resume(self, path=None):
        """Takes that back."""
        self._resume(_given(path))

    def set_speed(self, factor):
        """How many times faster than real time simulated time passes; 0: as fast as it can."""
        self._set_speed(factor)

    # What has happened.

    def events(self):
        """Warnings, faults and messages since the last call, as Event."""
        return [Event(*each) for each in self._events()]

    def faults(self):
        """The faults among the log: modules that threw, with what they threw."""
        return [each for each in self.log() if each.kind == "fault"]

    def log(self, begin=0):
        """What has happened since its start, from entry number `begin` on, as LogEntry."""
        return [LogEntry(*each) for each in self._log(begin)]

    def verdict(self):
        """What the modules that judge the run have to say, and whether all of it is good."""
        return self._verdicts()
