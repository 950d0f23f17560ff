"""Requests of a Remote that do not end as they should: an answer must never be taken for that of another request."""

import contextlib
import os
import signal
import socket
import threading
import time

import pytest

import runnel


class Served:
    """The other end of a control socket: answers each request with its words, "slow" ones when it is allowed to."""

    def __init__(self, folder):
        folder.mkdir(mode=0o700)
        self.asked = []
        self.hello = 'runnel protocol=1 process=1 application="robot" file=""'
        self.on_slow = lambda: None
        self.may_answer = threading.Event()
        self.listening = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self.listening.bind(str(folder / "1.sock"))
        self.listening.listen()
        threading.Thread(target=self.accept, daemon=True).start()

    def accept(self):
        while True:
            try:
                connection, _ = self.listening.accept()
            except OSError:
                return
            threading.Thread(target=self.serve, args=(connection,), daemon=True).start()

    def serve(self, connection):
        def send(kind, text):
            connection.sendall(f"{kind} {len(text)}\n{text}\n".encode())

        try:
            send("hello", self.hello)
            stream = connection.makefile("rb")
            for head in iter(stream.readline, b""):
                request = stream.read(int(head.split()[1]) + 1).decode().strip()
                self.asked.append(request)
                if head.startswith(b"at "):
                    continue
                if "slow" in request:
                    self.on_slow()
                    self.may_answer.wait(60)
                send("out", request)
                send("end", "0")
        except OSError:
            pass  # the client has hung up, or is hung up on
        with contextlib.suppress(OSError):
            connection.shutdown(socket.SHUT_RDWR)


@pytest.fixture
def served(tmp_path):
    served = Served(tmp_path / "run/runnel")
    yield served
    served.may_answer.set()
    served.listening.close()


def test_an_interrupted_request_leaves_no_answer_behind(served):
    served.on_slow = lambda: os.kill(os.getpid(), signal.SIGINT)
    with runnel.connect("robot") as app:
        with pytest.raises(KeyboardInterrupt):
            app.ask("get", "/slow")
        served.may_answer.set()
        assert app.ask("get", "/laser/noise") == 'get "/laser/noise"'
        assert app.ask("get", "/planner/speed") == 'get "/planner/speed"'


def test_after_a_time_out_requests_go_on_and_each_is_sent_once(served):
    with runnel.connect("robot") as app:
        app._timeout = 0.5
        with pytest.raises(TimeoutError, match="'get' was not answered within 0.5 s; .* may have carried it out"):
            app.ask("get", "/slow")
        app._timeout = 30  # whatever else the machine does
        assert app.ask("stop") == "stop"
        assert served.asked == ['get "/slow"', "stop"]


def test_a_request_says_when_it_was_sent_where_operators_must_be_heard(served):
    served.hello += " when=yes"
    before = time.monotonic_ns()
    with runnel.connect("robot") as app:
        assert app.ask("stop") == "stop"
    at, request = served.asked
    assert before <= int(at) <= time.monotonic_ns()
    assert request == "stop"


def test_a_file_may_have_blanks_in_its_name(served):
    served.hello = 'runnel protocol=1 process=1 application="robot" file="/data/a b/\\"c\\".xml" state="STOP, by=x"'
    with runnel.connect("robot") as app:
        assert app.file == '/data/a b/"c".xml'


def test_a_folder_that_others_can_enter_is_refused(served, tmp_path):
    os.chmod(tmp_path / "run/runnel", 0o777)  # in which anybody can pretend to be the robot
    with pytest.raises(runnel.Error, match="others cannot enter"):
        runnel.connect("robot")
    with pytest.raises(runnel.Error, match="others cannot enter"):
        runnel.applications()


class Watched:
    """A lock that tells when somebody wants it."""

    def __init__(self, lock):
        self.lock = lock
        self.is_wanted = threading.Event()

    def __enter__(self):
        self.is_wanted.set()
        return self.lock.__enter__()

    def __exit__(self, *how):
        return self.lock.__exit__(*how)


def test_a_request_says_when_it_was_asked_though_it_waits_for_another(served):
    served.hello += " when=yes"
    with runnel.connect("robot") as app:
        slow = threading.Thread(target=app.ask, args=("get", "/slow"))
        slow.start()
        while 'get "/slow"' not in served.asked:
            time.sleep(0.01)
        app._lock = Watched(app._lock)
        waits = threading.Thread(target=app.ask, args=("stop",))
        waits.start()
        assert app._lock.is_wanted.wait(60)
        later = time.monotonic_ns()
        served.may_answer.set()
        slow.join()
        waits.join()
    at, request = served.asked[-2:]
    assert request == "stop" and int(at) <= later


def test_a_call_may_take_its_own_time_besides(served):
    answered = threading.Timer(1, served.may_answer.set)
    served.on_slow = answered.start
    with runnel.connect("robot") as app:
        app._timeout = 0.2
        assert "slow" in app.call("/slow", timeout=60)


def test_an_application_that_goes_during_a_request_is_told_as_such(served):
    def hang_up():
        raise OSError

    served.on_slow = hang_up
    with runnel.connect("robot") as app:
        with pytest.raises(runnel.Error, match="has gone; .* may have carried it out"):
            app.ask("get", "/slow")


def test_a_closed_remote_stays_closed(served):
    app = runnel.connect("robot")
    app.close()
    with pytest.raises(runnel.Error, match="closed"):
        app.ask("get", "/laser/noise")
    assert served.asked == []
