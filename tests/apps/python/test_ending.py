"""However an application ends, and whatever goes on meanwhile, the interpreter goes on. Each in a process of its own."""

import os
import pathlib
import re
import subprocess
import sys

import pytest
import runnel
from own_process import ends_well

CALLS = {
    "wait": 'app.reader("/tick/out").wait(20)',
    "wait where nothing comes": 'app.reader("/gate/allowed", queue=3).wait(20)',
    "read": 'app.read("/tick/out")',
    "get": 'app.get("/tick/step")',
    "set": 'app.set("/tick/step", 2.0)',
    "publish": 'app.publish("/tick/wish", {"forward": 1})',
    "writer": 'app.writer("/tick/wish").publish(forward=1)',
    "swap": 'app.swap("/gate", "motion/command_gate")',
    "create": 'app.create(f"made{threading.get_ident()}", "motion/command_gate"); app.delete(f"/made{threading.get_ident()}")',
    "record": 'app.record(f"r{threading.get_ident()}.mcap").progress()',
    "call": 'app.call("/tick/reset", timeout=100)',
    "look": 'app.paths(); app.log(); app.events(); app.verdict(); app.time',
    "quit": 'app.quit(); app.start()',
}


@pytest.mark.parametrize("call", CALLS)
def test_close_waits_for_calls_under_way_and_later_ones_raise(call):
    ends_well(f'''
    def work(app):
        while True:
            try:
                {CALLS[call]}
            except ValueError as error:
                if "closed" in str(error):
                    ended.append(1)
                    return
            except runnel.Error:
                pass

    ended = []
    for i in range(8):
        app = ticking()
        threads = in_threads(3, lambda: work(app))
        time.sleep(0.02 + 0.003 * i)
        app.close()
        for each in threads:
            each.join()
    assert len(ended) == 24, ended
    print("done")
    ''')


def test_values_left_early():
    ends_well('''
    import asyncio

    async def look(app):
        async for _ in app.values("/gate/allowed"):
            pass

    async def main():
        with ticking() as app:
            task = asyncio.ensure_future(look(app))
            await asyncio.sleep(0.05)

    for _ in range(5):
        asyncio.run(main())
    print("done")
    ''')


@pytest.mark.parametrize("call", ["run()", "run_for(1e9)", "step(10**9)"])
def test_close_ends_what_runs_cycles(call):
    ends_well(f'''
    app = ticking(clock="simulated", start=False)
    raised = []

    def work():
        try:
            app.{call}
        except ValueError as error:
            raised.append(str(error))

    threads = in_threads(1, work)
    while app.time == 0:
        pass
    app.close()
    threads[0].join()
    assert raised == ["the application is closed"], raised
    print("done")
    ''')


def test_one_call_at_a_time_runs_cycles_and_quit_ends_it():
    ends_well('''
    app = ticking(clock="simulated", start=False)
    threads = in_threads(1, lambda: app.run_for(1e9))
    while app.time == 0:
        pass
    for call in (app.step, app.run, app.start):
        try:
            call()
            raise AssertionError(call)
        except runnel.Error as error:
            assert "another call runs" in str(error), error
    app.quit()
    threads[0].join()
    app.step()
    app.close()
    print("done")
    ''')


def test_two_threads_quit_and_close():
    ends_well('''
    for i in range(20):
        app = ticking()
        threads = in_threads(4, app.quit if i % 2 else app.close)
        for each in threads:
            each.join()
        app.close()
    print("done")
    ''')


def test_a_daemon_thread_waits_when_the_script_ends():
    for _ in range(3):
        ends_well('''
        app = ticking()
        reader = app.reader("/gate/allowed")

        def wait():
            while True:
                try:
                    reader.wait(1)
                except ValueError:
                    return

        threading.Thread(target=wait, daemon=True).start()
        time.sleep(0.05)
        print("done")
        ''')


COLLECTING = '''
class Collecting(runnel.Module):
    period = 0.01
    out = runnel.Output("double")

    def __init__(self):
        if "make" in sys.argv:
            gc.collect()

    def update(self):
        if "update" in sys.argv:
            gc.collect()
        self.out.publish(1.0)


def garbage(what):
    circle = [what]
    circle.append(circle)


gc.disable()
'''


@pytest.mark.parametrize("where", ["update", "make"])
def test_what_is_garbage_is_collected_within_a_module(where):
    ends_well(COLLECTING + '''
for make in (lambda app: ticking(), lambda app: app.reader("/gate/allowed"), lambda app: app.writer("/gate/wanted"),
             lambda app: app.record("run.mcap")):
    with ticking(clock="simulated", start=False) as app:
        app.create("first", Collecting)
        garbage(make(app))
        app.create("second", Collecting)
        app.run_for(0.1)
        assert app.read("/second/out") == 1.0, app.faults()
        assert not app.faults(), app.faults()
print("done")
''', where)


def test_close_and_what_waits_are_refused_in_update():
    ends_well('''
    class Closing(runnel.Module):
        period = 0.01
        out = runnel.Output("double")

        def update(self):
            for call in (app.close, app.step, app.undo, lambda: app.get("/tick/step"), lambda: runnel.compose("other")):
                try:
                    call()
                    raise AssertionError(call)
                except runnel.Error as error:
                    assert error.hint
            self.out.publish(1.0)

    app = ticking(clock="simulated", start=False)
    app.create("closing", Closing)
    app.run_for(0.1)
    assert app.read("/closing/out") == 1.0, app.faults()
    app.close()
    print("done")
    ''')


INTERRUPTED = '''
class Interrupted(runnel.Module):
    period = 0.01
    count = 0

    def update(self):
        self.count += 1
        if self.count == 5:
            os.kill(os.getpid(), signal.SIGINT)
            for _ in range(10**9):
                pass


app = ticking(clock="simulated", start=False)
app.create("interrupted", Interrupted)
'''


@pytest.mark.parametrize("call", ["run()", "run_for(1e9)", "step(10**9)"])
def test_an_interrupt_in_update_ends_the_call_and_is_no_fault(call):
    ends_well(INTERRUPTED + f'''
try:
    app.{call}
    raise AssertionError("not interrupted")
except KeyboardInterrupt:
    assert not app.faults(), app.faults()
app.run_for(0.1)
app.close()
print("done")
''')


def test_an_interrupt_while_a_value_is_made_is_no_fault():
    ends_well('''
    class Interrupts:
        def __float__(self):
            os.kill(os.getpid(), signal.SIGINT)
            for _ in range(10**9):
                pass

    class Publishes(runnel.Module):
        period = 0.01
        out = runnel.Output("double")

        def update(self):
            self.out.publish(Interrupts())

    app = ticking(clock="simulated", start=False)
    app.create("publishes", Publishes)
    try:
        app.run_for(1e9)
    except KeyboardInterrupt:
        assert not app.faults(), app.faults()
        app.close()
        print("done")
    ''')


def test_an_interrupt_ends_cycles_of_modules_in_cpp():
    ends_well('''
    app = runnel.compose("cpp", clock="simulated")
    app.thread("control", 0.005)
    app.create("gate", "motion/command_gate")
    threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
    try:
        app.step(10**15)
    except KeyboardInterrupt:
        app.close()
        print("done")
    ''')


def test_a_signal_handler_ends_a_run_by_quit():
    ends_well('''
    told = []

    def handler(*unused):
        try:
            app.close()
        except runnel.Error as error:
            told.append(error.hint)
        app.quit()

    signal.signal(signal.SIGTERM, handler)
    with ticking(clock="simulated", start=False) as app:
        threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGTERM)).start()
        app.run_for(1e9)
    assert told and "quit()" in told[0]
    print("done")
    ''')


def test_16_threads_close_at_random(tmp_path):
    closes = os.environ.get("RUNNEL_CLOSES", "0")  # a long version: 10000
    done = subprocess.run([sys.executable, str(pathlib.Path(__file__).with_name("close_under_load.py")), closes], capture_output=True,
                          text=True, cwd=tmp_path)
    assert done.returncode == 0 and done.stdout.endswith("wrong []\n"), done.stdout + done.stderr[-6000:]


def test_modules_are_made_while_others_look():
    ends_well('''
    class Many(runnel.Module):
        a, b, c = (runnel.Parameter(1.0) for _ in range(3))
        x, y = runnel.Input("double"), runnel.Output("double")

        @runnel.service
        def reset(self, to: float = 0) -> float:
            return to

        def update(self):
            pass

    def look():
        while not over:
            try:
                app.call("/tick/reset", to=1.0)
            except runnel.Error:
                pass

    over = False
    sys.setswitchinterval(1e-5)
    app = ticking()
    threads = in_threads(4, look)
    for i in range(60):
        app.create(f"many{i}", Many)
        app.delete(f"/many{i}")
    over = True
    for each in threads:
        each.join()
    app.close()
    print("done")
    ''')


def test_ports_of_a_module_that_goes_while_another_thread_uses_them():
    ends_well('''
    class Shares(runnel.Module):
        period = 0.002
        out = runnel.Output("double")
        other = runnel.Client("double", {"to": "double"})

        def __init__(self):
            shared.append(self)

        def update(self):
            pass

    class Slow:
        def __float__(self):
            time.sleep(0.001)
            return 1.0

    def publish():
        while not over:
            for each in shared[-1:]:
                try:
                    each.out.publish(Slow())
                    each.other.send(Slow())
                except (ValueError, runnel.Error):
                    pass

    shared, over = [], False
    app = ticking(Shares)
    threads = in_threads(3, publish)
    for _ in range(100):
        app.delete("/tick")
        app.create("tick", Shares)
    over = True
    for each in threads:
        each.join()
    app.close()
    print("done")
    ''')


@pytest.mark.parametrize("how", ["app.swap('/tick', Shares)", "app.reload()", "app.swap('/tick', Shares); app.delete('/tick')"])
def test_another_module_takes_the_ports_when_calls_of_them_have_ended(how):
    ends_well(f'''
    class Shares(runnel.Module):
        period = 0.002
        many = runnel.Output("double[]")
        wish = runnel.Input("Twist2")

        def prepare(self):
            shared.append(self)

        def update(self):
            pass

    class Waits:
        """A number that is not there before others have gone on, and that looks at another port meanwhile."""

        def __float__(self):
            inside.set()
            time.sleep(0.1)
            shared[0].wish.read()
            try:
                app.get("/tick/step")
            except runnel.Error as error:
                told.append(error.hint)
            over.append(True)
            return 1.0

    def publish():
        shared[0].many.publish([Waits()])

    shared, over, told = [], [], []
    inside = threading.Event()
    app = ticking(Shares)
    thread = in_threads(1, publish)[0]
    inside.wait()
    {how}
    assert over and told, (over, told)
    thread.join()
    app.close()
    print("done")
    ''')


def test_no_module_takes_ports_that_a_thread_does_not_let_go_of():
    ends_well('''
    class Shares(runnel.Module):
        period = 0.002
        many = runnel.Output("double[]")

        def prepare(self):
            shared.append(self)

        def update(self):
            pass

    class Waits:
        def __float__(self):
            inside.set()
            go.wait()
            return 1.0

    shared = []
    inside, go = threading.Event(), threading.Event()
    app = ticking(Shares)
    thread = in_threads(1, lambda: shared[0].many.publish([Waits()]))[0]
    inside.wait()
    try:
        app.swap("/tick", Shares)
    except runnel.Error as error:
        assert "still uses its ports" in str(error), error
        go.set()
        thread.join()
        assert len(app.read("/tick/many")) == 1  # the one before is in its place
        app.swap("/tick", Shares)
        app.close()
        print("done")
    ''')


def test_a_module_is_called_back_in_its_own_cycles_only():
    ends_well('''
    class Asks(runnel.Module):
        period = 0.002
        other = runnel.Client("double", {"to": "double"})

        def prepare(self):
            shared.append(self)

        def update(self):
            pass

    shared = []
    app = ticking(Asks)
    try:
        shared[0].other.call(print, 1.0)
    except ValueError as error:
        assert "begin()" in str(error)
        app.close()
        print("done")
    ''')


def test_the_one_who_records_is_made_once():
    ends_well('''
    for i in range(20):
        app = ticking(start=False)
        threads = in_threads(4, lambda: app.record(f"r{threading.get_ident()}.mcap").close())
        for each in threads:
            each.join()
        app.close()
    print("done")
    ''')


def test_a_caught_exception_keeps_an_application_that_ends_in_update():
    ends_well('''
    class Clears(runnel.Module):
        period = 0.01

        def update(self):
            kept.clear()

    def fail():
        old = ticking()
        old.read("/nothing")

    kept = []
    try:
        fail()
    except runnel.Error as error:
        kept.append(error)
    with runnel.compose("new", clock="simulated") as app:
        app.create("clears", Clears)
        app.run_for(0.1)
        assert not kept and not app.faults(), app.faults()
    print("done")
    ''')


def test_an_interrupt_while_attributes_are_handed_over_is_no_error_of_the_change():
    ends_well('''
    class Changed(runnel.Module):
        def __setattr__(self, name, value):
            if name == "count":
                os.kill(os.getpid(), signal.SIGINT)
                for _ in range(10**9):
                    pass
            super().__setattr__(name, value)

        def update(self):
            pass

    class Counts(runnel.Module):
        count = 0

        def update(self):
            self.count += 1

    app = ticking(Counts, clock="simulated", start=False)
    app.run_for(0.1)
    try:
        app.swap("/tick", Changed)
    except KeyboardInterrupt:
        app.run_for(0.1)
        assert not app.faults(), app.faults()
        app.close()
        print("done")
    ''')


def test_what_is_not_loaded_can_be_shown_and_closed():
    ends_well('''
    app = runnel.Application.__new__(runnel.Application)
    assert repr(app) == "<runnel.Application, closed>"
    try:
        app.close()
    except RuntimeError:
        print("done")
    ''')


def test_the_load_calls_all_there_is():
    """What is new here belongs into close_under_load.py, too."""
    said = set(re.findall(r"\.(\w+)", pathlib.Path(__file__).with_name("close_under_load.py").read_text()))
    extension = runnel._extension
    for kind in (runnel.Application, runnel.Reader, runnel.Writer, runnel.Remote, runnel.Recording, extension.RunningRecording,
                 extension.ModuleInput, extension.ModuleOutput, extension.ModuleClient, extension.ModuleCall, extension.ModuleActivity):
        missing = {name for name in dir(kind) if not name.startswith("_")} - said
        assert not missing, (kind, missing)
