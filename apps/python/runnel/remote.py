"""Running applications, reached through their control sockets: `runnel.connect("bug_demo")`."""

import asyncio
import contextlib
import io
import os
import pathlib
import re
import socket
import stat
import threading
import time
import weakref

from runnel import _extension
from runnel._changes import Changes
from runnel._text import quoted, text_of
from runnel.application import _STOP, KINDS, _port, check_kind


def _folder():
    base = os.environ.get("XDG_RUNTIME_DIR")
    folder = pathlib.Path(base) / "runnel" if base else pathlib.Path(f"/tmp/runnel-{os.getuid()}")
    with contextlib.suppress(FileNotFoundError):
        said = folder.lstat()
        if not stat.S_ISDIR(said.st_mode) or said.st_uid != os.getuid() or said.st_mode & 0o077:
            # As `runnel ps`: whoever can make sockets there can pretend to be a robot.
            raise _extension.Error(f"{folder}: sockets are looked for only in a folder of this user's that others cannot enter (mode 0700)")
    return folder


def _words(text):
    """The name=value of a line, as the terminal's language has them."""
    escaped = {"n": "\n", "t": "\t", "r": "\r"}
    found = re.findall(r'(\w+)=(?:"((?:[^"\\]|\\.)*)"|(\S*))', text)
    return {name: plain or re.sub(r"\\(.)", lambda each: escaped.get(each[1], each[1]), marked) for name, marked, plain in found}


def _request(command, arguments, options, body):
    words = [command] + [quoted(each) for each in arguments]
    words += [f"{name}={quoted(value)}" for name, value in options.items() if value is not None]
    payload = " ".join(words).encode() + (b"\n" + body.encode() if body else b"")
    return b"request %d\n%s\n" % (len(payload), payload)


def _error(text):
    """What the application says against it, as runnel.Error."""
    line = text.strip()
    line = line.removeprefix("error: ")
    error = _extension.Error(line)
    found = re.match(r"(?:(?P<path>/\S*): )?(?P<message>[^;]*)(?:; (?P<hint>.*))?", line, re.S)
    error.message, error.hint = found["message"].removeprefix("error: "), found["hint"] or ""
    error.path = found["path"] or ""
    return error


_sockets, _remotes = weakref.WeakSet(), weakref.WeakSet()
_left = []


def _leave_all():
    # A forked child must not take answers that are its parent's, and has none of the threads that may hold a lock.
    for each in list(_sockets):
        each.leave()
    for each in list(_remotes):
        each._begin()


os.register_at_fork(after_in_child=_leave_all)


class _Socket:
    """One connection: requests in turn, of whichever thread."""

    def __init__(self, path, timeout):
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self.stream = None
        _sockets.add(self)
        self.socket.settimeout(timeout)
        try:
            self.socket.connect(str(path))
            self.stream = self.socket.makefile("rb")
            kind, hello = self.receive()
        except BaseException:
            self.close()
            raise
        self.hello = _words(hello.decode())
        if kind != "hello" or self.hello.get("protocol") != "1":
            self.close()
            raise _extension.Error(f"{path} speaks another protocol")

    def send(self, request, asked):
        at = b"%d" % asked  # the same clock in all processes of a machine
        heard = b"at %d\n%s\n" % (len(at), at) if self.hello.get("when") == "yes" else b""
        self.socket.sendall(heard + request)

    def receive(self):
        head = self.stream.readline().decode().split()
        size = int(head[1]) if len(head) == 2 else 0
        payload = self.stream.read(size + 1)
        if len(head) != 2 or len(payload) != size + 1:
            raise _extension.Error("the application has gone")
        return head[0], payload[:-1]

    def leave(self):
        if (file := self.socket.detach()) >= 0:
            os.close(file)
        _left.append(self.stream)  # closing it may want a lock
        self.stream = io.BytesIO()  # as if the application had gone

    def close(self):
        if self.stream is not None:
            with contextlib.suppress(OSError):
                self.stream.close()
        self.socket.close()


def _exchange(connection, request, asked):
    """Exit code, output and errors. `asked`: when, by time.monotonic_ns()."""
    connection.send(request, asked)
    said = {"out": [], "err": []}
    while True:
        kind, payload = connection.receive()
        if kind == "end":
            return payload.split()[:1], b"".join(said["out"]).decode(), b"".join(said["err"]).decode()
        said.setdefault(kind, []).append(payload)


def _outcome(code, out, errors):
    if code != [b"0"]:
        raise _error(errors or out)
    return out


def applications():
    """The running applications of this user that can be reached: {process: name}."""
    found = {}
    for path in sorted(_folder().glob("*.sock")):
        try:
            connection = _Socket(path, 5)
        except (OSError, _extension.Error):
            continue  # left by a process that is gone
        found[int(connection.hello["process"])] = connection.hello["application"]
        connection.close()
    return found


def connect(application="", timeout=30.0):
    """The running application of this name or process; "": the only one. timeout -- s, for an answer."""
    there = {}
    for path in sorted(_folder().glob("*.sock")):
        try:
            there[path] = _Socket(path, timeout)
        except (OSError, _extension.Error):
            continue
    wanted = str(application)
    fits = [path for path, each in there.items() if wanted in ("", each.hello["application"], each.hello["process"])]
    names = ", ".join(f"{each.hello['application']} ({each.hello['process']})" for each in there.values()) or "none"
    for path, each in there.items():
        if fits != [path]:
            each.close()
    if len(fits) != 1:
        raise _extension.Error(f"{'no' if not fits else 'more than one'} running application fits '{wanted}'; there is {names}")
    return Remote(fits[0], there[fits[0]], timeout)


class Remote(Changes):
    """A running application in another process: the same words as runnel.Application.

    Whatever ends a request before its answer is there (a time-out, Ctrl-C) closes the connection, and the next request
    opens another: the application may have carried out the request all the same. Threads: any; requests of several wait
    for one another.
    """

    def __init__(self, path, connection, timeout):
        self._path = path
        self._is_closed = False
        self._timeout = timeout
        self._begin(connection)
        _remotes.add(self)
        self._types = {}
        self.name = connection.hello["application"]
        self.process = int(connection.hello["process"])
        self.file = connection.hello.get("file", "")

    def _begin(self, connection=None):
        self._connection = connection
        self._lock = threading.Lock()

    def __repr__(self):
        return f"<runnel.Remote {self.name}, process {self.process}>"

    def __enter__(self):
        return self

    def __exit__(self, *unused):
        self.close()

    def close(self):
        """Hangs up for good; the application runs on."""
        self._is_closed = True
        self._hang_up()

    def _hang_up(self):
        connection, self._connection = self._connection, None
        if connection is not None:
            connection.close()

    def ask(self, command, *arguments, body="", **options):
        """What `runnel COMMAND` would print; what it would print as an error is a runnel.Error."""
        return self._ask(command, arguments, options, body)

    def _ask(self, command, arguments, options, body="", besides=0.0):
        request = _request(command, arguments, options, body)
        patience = None if self._timeout is None else self._timeout + besides
        asked = time.monotonic_ns()  # those of other threads may take long, and STOP may be pressed meanwhile
        with self._lock:
            if self._is_closed:
                raise _extension.Error("this Remote has been closed")
            if self._connection is None:
                try:
                    self._connection = _Socket(self._path, self._timeout)
                except OSError as why:
                    raise _extension.Error(f"'{command}' has not been sent: {self.name} cannot be reached: {why}") from None
            connection = self._connection
            try:
                connection.socket.settimeout(patience)
                code, out, errors = _exchange(connection, request, asked)
            except BaseException as why:
                self._hang_up()  # an answer that is still on its way is nobody's
                perhaps = "; the application may have carried it out all the same"
                if isinstance(why, TimeoutError):
                    raise TimeoutError(f"'{command}' was not answered within {patience:g} s{perhaps}") from None
                if isinstance(why, (OSError, _extension.Error)):
                    raise _extension.Error(f"'{command}': {why}{perhaps}") from None
                raise
        return _outcome(code, out, errors)

    # Looking.

    def paths(self, kind=None):
        """(path, kind, type) of all elements, or of those of one kind."""
        check_kind(kind, (*KINDS, "thread", "ports", "element"))
        rows = [line.split("\t") for line in self.ask("paths").split("\n") if line]
        found = []
        for row in rows:
            type = row[3] if len(row) > 3 else ""
            if row[0] in ("input", "output", "parameter"):
                self._types[row[1]] = type
            its_kind = "service" if row[0] == "output" and type.startswith("service ") else row[0]
            if kind is None or its_kind == kind:
                found.append((row[1], its_kind, type))
        return found

    def _type_of(self, path):
        wanted = [part for part in path.split("/") if part]
        for attempt in range(2):
            for each, type in self._types.items():
                parts = [part for part in each.split("/") if part]
                for whole in (parts, parts[:-2] + parts[-1:]):
                    if wanted in (whole, whole[1:]):
                        return type
            if attempt == 0:
                self.paths()
        return ""

    def _value(self, path, text):
        type = self._type_of(path)
        try:
            return _extension.make(type, text) if type else text
        except _extension.Error:
            return text  # of a plugin that is not installed here

    def get(self, path):
        """The value of a parameter, or the newest at a port."""
        return self._value(path, self.ask("get", path, full="yes").removesuffix("\n"))

    def read(self, path):
        """The newest value of a port; None if there is none yet."""
        try:
            return self.get(path)
        except _extension.Error as error:
            if "nothing has been published" in error.message:
                return None
            raise

    def __getitem__(self, path):
        return self.get(path)

    def __setitem__(self, path, value):
        self.set(path, value)

    def log(self):
        """The lines of the log."""
        return [line for line in self.ask("log").split("\n") if line]  # texts may have other ends of lines in them

    def faults(self):
        """Those of them that are faults."""
        return [each for each in self.log() if "  fault " in each]

    # Changing.

    def set(self, path, value):
        """Sets a parameter."""
        self.apply(f"set {quoted(path)} {quoted(text_of(value))}")

    def apply(self, text):
        """Changes as text, all or none."""
        return self.ask("change", body=text)

    def undo(self):
        """Takes the last change back."""
        return self.ask("undo")

    def redo(self):
        """Makes it again."""
        return self.ask("redo")

    def save(self, file="", overwrite=False):
        """Saves what it is now to the file; "": the one that it came from."""
        return self.ask("save", *([os.path.abspath(file)] if file else []), overwrite="yes" if overwrite else None)

    def reload(self, plugin="python"):
        """Loads a plugin anew, and makes its modules anew."""
        return self.ask("reload", plugin)

    def publish(self, path, value):
        """Sets the value at a port by hand, until release()."""
        self.ask("publish", path, text_of(value))

    def stop(self):
        """STOP of the robot: all that moves something has its safe value, until release(). By a connection of its own: no
        request of another thread delays it. Raises also where STOP is in force and nothing is marked as driving.
        """
        try:
            code, out, errors = self._exchange_alone("stop")
            if not out:
                raise _error(errors)
        except _extension.Error as why:
            raise _extension.Error(f"the STOP of {self.name} is not confirmed: {why}") from None
        return _outcome(code, out, errors)

    def release(self, path=_STOP):
        """Ends the STOP; with the path of a port, its block and the value set by hand there. None is no path, and refused. If
        STOP is pressed again before the application has it, it raises and STOP stays.
        """
        return _outcome(*self._exchange_alone("release", *([] if path is _STOP else [_port(path)])))

    def _exchange_alone(self, command, *arguments):
        asked = time.monotonic_ns()
        try:
            with contextlib.closing(_Socket(self._path, 5)) as connection:
                return _exchange(connection, _request(command, arguments, {}, ""), asked)
        except OSError as why:
            raise _extension.Error(f"{self.name} does not answer: {why}") from None

    def block(self, path):
        """Stops one port: its readers have the safe value, whatever anybody publishes, until release(path)."""
        return self.ask("block", path)

    def call(self, path, argument=None, timeout=30.0, **arguments):
        """Calls a service; its reply in the text format. timeout -- s, on the application's clock."""
        if arguments and argument is not None:
            raise TypeError("a call has one argument, or arguments by their names")
        words = [text_of(arguments or argument)] if arguments or argument is not None else []
        return self._ask("call", [path, *words], {"timeout": f"{timeout}s"}, besides=timeout).removesuffix("\n")

    def record(self, file, seconds=None, ports=()):
        """Records for so many seconds of the machine's, or until the returned object is closed."""
        request = _request("record", list(ports), {"file": os.path.abspath(file), "count": seconds}, "")
        try:
            connection = _Socket(self._path, None)
            connection.send(request, time.monotonic_ns())
            recording = _Recording(connection)
            if seconds is not None:
                recording.wait()
            else:
                recording.begin()
        except OSError as why:
            raise _extension.Error(f"{self.name} does not answer: {why}") from None
        return recording

    # Its time.

    def pause(self, path=None):
        """Pauses simulated time, or leaves what is at or below `path` out of cycles."""
        return self.ask("pause", *([] if path is None else [path]))

    def resume(self, path=None):
        """Takes that back."""
        return self.ask("resume", *([] if path is None else [path]))

    def step(self, cycles=1):
        """Pauses, and lets so many cycles run."""
        return self.ask("step", str(cycles))

    def set_speed(self, factor):
        """How many times faster than real time simulated time passes; 0: as fast as it can."""
        return self.ask("speed", repr(float(factor)))

    def quit(self):
        """Ends the run."""
        return self.ask("quit")

    async def values(self, path):
        """The values of a port as they come, as (time in s, value): ``async for time, twist in app.values(path)``.

        As a person would see them: up to 200 a second, the newest of them.
        """
        self._type_of(path)
        reader, writer = await asyncio.open_unix_connection(str(self._path))
        try:
            await _receive(reader)  # hello
            writer.write(_request("echo", [path], {"full": "yes"}, ""))
            said = []
            while True:
                kind, payload = await _receive(reader)
                if kind == "err":
                    said.append(payload.decode())
                if kind == "end":
                    if payload.split()[:1] != [b"0"]:
                        raise _error("".join(said))
                    return
                if kind == "out":  # one value: its text may have lines, and look like this
                    found = re.fullmatch(r"(\S+) s  \(measured at \S+ s, \d+ not shown\)  (.*)\n", payload.decode(), re.S)
                    yield float(found[1]), self._value(path, found[2])
        finally:
            writer.close()


async def _receive(reader):
    head = (await reader.readline()).decode().split()
    if len(head) != 2:
        raise _extension.Error("the application has gone")
    payload = await reader.readexactly(int(head[1]) + 1)
    return head[0], payload[:-1]


class _Recording:
    """A recording that goes on in an application."""

    def __init__(self, connection):
        self._connection = connection

    def _next(self):
        kind, payload = self._connection.receive()
        if kind == "end" and payload.split()[:1] != [b"0"]:
            raise _error(self._said)
        self._said = payload.decode() if kind == "err" else ""
        return kind

    _said = ""

    def begin(self):
        """Returns when it has begun."""
        self._next()

    def wait(self):
        """Returns when it is over."""
        while self._next() != "end":
            pass
        self._connection.close()

    def close(self):
        """Ends it, and waits until the file is whole."""
        with contextlib.suppress(_extension.Error, OSError):
            self._connection.socket.shutdown(socket.SHUT_WR)
            self.wait()
        self._connection.close()

    def __enter__(self):
        return self

    def __exit__(self, *unused):
        self.close()
