"""STOP of the robot, the block of one port, and the end of a run, in this process and from another."""

import os
import threading
import time

import pytest

import runnel

APPLICATION = """
<application name="base"> <load plugin="motion"/> <clock type="real"/> <thread name="control" period="5ms"/>
  <module name="gate" type="motion/command_gate"/> <module name="after" type="motion/command_gate"/>
  <driving port="after/wanted"/> <connect from="gate/allowed" to="after/wanted"/> <connect from="after/allowed" to="gate/wanted" late="true"/>
</application>"""


@pytest.fixture
def base():
    with runnel.load_text(APPLICATION, control=True) as app:
        app.start()
        yield app


def test_stop_is_in_force_until_it_is_released(base):
    base.stop()
    base.stop()  # twice does no harm
    base.release()
    with pytest.raises(runnel.Error, match="not in force"):
        base.release()


def stop_until_it_is_kept(app):
    for _ in range(200):
        try:
            return app.stop()
        except runnel.Error as why:  # a disk that is slow
            assert "would not know of it yet" in str(why)
    raise AssertionError("it is not kept")


def release(app, files):
    try:
        app.release()
    except runnel.Error as why:
        assert "would not know of it yet" in str(why)
    for _ in range(1500):
        if not files():
            return
        time.sleep(0.02)
    raise AssertionError("the next process would begin under STOP")


@pytest.fixture
def robot(tmp_path):
    """An application's file, and what lists the files by which the next process knows of a STOP."""
    file = tmp_path / "base.xml"
    file.write_text(APPLICATION)
    return file, lambda: [each for each in (tmp_path / "run" / "runnel").glob("*.stop") if not each.name.startswith(".")]


def test_a_stop_outlives_the_process_where_the_application_has_a_file(robot):
    file, files = robot
    with runnel.load(file, control=True) as app:
        stop_until_it_is_kept(app)
        assert len(files()) == 1, "when stop() has returned"
    with pytest.warns(Warning, match="begins under STOP, pressed by Python"):
        again = runnel.load(file, control=True)
    with again:
        release(again, files)
    with runnel.load_text(APPLICATION, control=True) as app:
        app.stop()
        assert not files(), "it would be nobody's"


def test_a_stop_that_is_not_kept_yet_is_in_force_and_says_so(robot):
    file, files = robot
    with runnel.load(file, control=True) as app:
        stop_until_it_is_kept(app)
        [kept] = files()
        release(app, files)
        pipe = kept.parent / ("." + kept.name)
        os.mkfifo(pipe, 0o600)  # as a disk that does not answer
        with pytest.raises(runnel.Error, match="STOP is in force, and the next process would not know of it yet"):
            app.stop()
        reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
        stop_until_it_is_kept(app)
        os.close(reader)


def test_a_stop_that_stops_nothing_raises_and_is_in_force():
    with runnel.load_text('<application name="idle"><clock type="real"/></application>', control=True) as app, runnel.connect("idle") as far:
        for stop in (app.stop, far.stop):
            with pytest.raises(runnel.Error, match="STOP stops nothing"):
                stop()
            app.release()  # which raises if it is not in force


def test_a_stop_that_does_not_reach_all_raises_and_is_in_force(base):
    base.pause("/after")
    with runnel.connect("base") as far:
        for stop in (base.stop, far.stop):
            with pytest.raises(runnel.Error, match="after/.*wanted.*cannot be reached: .*is paused"):
                stop()
            base.release()  # which raises if it is not in force
    base.resume("/after")
    base.stop()


def test_one_port_is_blocked_until_it_is_released(base):
    base.block("/gate/wanted")
    with pytest.raises(runnel.Error, match="no 'gat'"):
        base.block("/gat/wanted")
    base.release("/gate/wanted")
    with pytest.raises(runnel.Error):
        base.release("/gate/wanted")
    with pytest.raises(runnel.Error, match="the path is empty"):
        base.release("")


def test_none_and_the_word_of_the_terminal_do_not_end_the_stop(base):
    with runnel.connect("base") as far:
        for stop, release in ((base.stop, base.release), (far.stop, far.release)):
            stop()
            for wrong in (None, "stop"):
                with pytest.raises(runnel.Error, match=r"is no port; release\(\) without a path ends the STOP"):
                    release(wrong)
            with pytest.raises(runnel.Error, match="is no port"):
                release(path=None)
            release()  # which raises if it is not in force


def test_an_empty_path_is_not_the_whole_application(base):
    for do in (base.pause, base.resume, base.release):
        with pytest.raises(runnel.Error):
            do("")
    with runnel.connect("base") as far:
        for do in (far.pause, far.resume, far.release, far.block):
            with pytest.raises(runnel.Error, match="one of its words is empty"):
                do("")


def test_a_stop_that_is_not_confirmed_says_so(base, tmp_path):
    with runnel.connect("base") as far:
        far._path = tmp_path / "nobody.sock"
        with pytest.raises(runnel.Error, match="the STOP of base is not confirmed: "):
            far.stop()
        with pytest.raises(runnel.Error, match="base does not answer: "):
            far.record("far.mcap")


def test_the_same_from_another_process(base):
    with runnel.connect("base") as far:
        assert "STOP is in force" in far.stop()
        with pytest.raises(runnel.Error, match="not in force"):
            far.release(), far.release()
        assert "is blocked" in far.block("/gate/wanted")
        far.release("/gate/wanted")
        with pytest.raises(runnel.Error, match="one of its words is empty"):
            far.release("")


def test_stop_does_not_wait_for_another_request(base):
    with runnel.connect("base") as far:
        with far._lock:  # as while another thread waits for an answer
            asking = threading.Thread(target=far.stop, daemon=True)
            asking.start()
            asking.join(30)
            assert not asking.is_alive()
        assert "released" in far.release()


def test_quit_ends_the_run(base):
    with runnel.connect("base") as far:
        far.quit()
    for _ in range(3000):
        if not base.is_running:
            return
        time.sleep(0.02)
    raise AssertionError("it runs on")
