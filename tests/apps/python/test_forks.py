"""Processes that are forked while applications are open."""

import pytest

from own_process import ends_well


def test_a_forked_child_is_told_and_ends():
    ends_well('''
    import multiprocessing, warnings

    def asked(_):
        try:
            app.read("/tick/out")
        except runnel.Error as error:
            return str(error)

    app = ticking()
    recording = app.record("run.mcap")
    with multiprocessing.get_context("fork").Pool(2) as pool:
        told = pool.map(asked, range(4))
    assert all("'spawn'" in each for each in told), told
    child = os.fork()
    if child == 0:
        app.close()
        del recording
        gc.collect()
        sys.exit(7)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 7
    assert app.reader("/tick/out").wait(20)
    app.close()
    print("done")
    ''')


REMOTE = '''
    app = ticking(clock="simulated", start=False)
    app.close()
    os.environ["XDG_RUNTIME_DIR"] = os.getcwd()
    os.chmod(".", 0o700)
    app = runnel.compose("served", clock="simulated", control=True)
    app.create("gate", "motion/command_gate")
    far = runnel.connect("served")
'''


def test_a_child_has_connections_of_its_own():
    ends_well(REMOTE + '''
    def ask():
        while True:
            with lock:
                if over:
                    return
            assert "gate" in str(far.paths())

    lock, over = threading.Lock(), False
    threads = in_threads(2, ask)
    for _ in range(10):
        child = os.fork()
        if child == 0:
            ok = all("served" in str(far.paths("group")) or "gate" in str(far.paths()) for _ in range(5))
            os._exit(7 if ok else 1)
        assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 7
    with lock:
        over = True
    for each in threads:
        each.join()
    app.close()
    print("done")
    ''')


def test_a_child_does_not_end_its_parents_recording():
    ends_well(REMOTE + '''
    with far.record("far.mcap", ports=["/gate/*"]) as recording:
        child = os.fork()
        if child == 0:
            try:
                recording.close()
            finally:
                os._exit(7)
        assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 7
        app.publish("/gate/wanted", {"forward": 1})
        app.run_for(0.5)
    assert sum(len(runnel.read("far.mcap")[each]) for each in runnel.read("far.mcap")) > 0
    app.close()
    print("done")
    ''')


@pytest.mark.parametrize("clock", ["simulated", "real"])
@pytest.mark.parametrize("end, code", [
    ("return", 0), ("sys.exit(7)", 7), ("sys.stdout.close(); return", 0), ("raise ValueError('of the child')", 1),
    ("sys.exit('of the child')", 1), ("raise type('Coded', (Exception,), {'code': None})('of the child')", 1)])
def test_a_child_that_is_forked_in_update_ends_there(clock, end, code):
    told = ends_well(f"""
    class Forking(runnel.Module):
        period = 0.002
        out = runnel.Output("double")
        child = None

        def update(self):
            if Forking.child is None:
                Forking.child = os.fork()
                if Forking.child == 0:
                    {end}
            self.out.publish(1.0)

    app = ticking(Forking, clock="{clock}", start={clock == "real"})
    reader = app.reader("/tick/out")
    if not app.is_running:
        app.run_for(0.1)
    assert reader.wait(20)
    assert os.waitstatus_to_exitcode(os.waitpid(Forking.child, 0)[1]) == {code}
    app.close()
    print("done")
    """)
    assert ("of the child" in told) == (code == 1), told
    assert ("Traceback" in told) == end.startswith("raise"), told
