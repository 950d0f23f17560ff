"""The interpreter ends while applications are open."""

import pytest
from own_process import ends_well

INTERRUPTED_AT_THE_END = '''
class Slow(runnel.Module):
    period = 0.002
    out = runnel.Output("double")

    def update(self):
        time.sleep(0.05)
        self.out.publish(1.0)


def read():
    while True:
        try:
            reader.wait(30)
            reader.read()
        except ValueError:
            return


class Never(runnel.Module):
    def update(self):
        has_begun.set()
        while True:
            time.sleep(0.01)


def interrupt():
    while True:
        time.sleep(0.02)
        os.kill(os.getpid(), signal.SIGINT)


has_begun = threading.Event()
app = ticking(Slow)
reader = app.reader("/tick/out")
threading.Thread(target=read, daemon=True).start()
'''


@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM"])
@pytest.mark.parametrize("delay", [0.0, 0.01, 0.03])
def test_a_signal_while_the_interpreter_ends_does_not_break_it_off(name, delay):
    ends_well(INTERRUPTED_AT_THE_END + f'''
import atexit
signal.signal(signal.SIGTERM, lambda *unused: sys.exit(7))
atexit.register(lambda: threading.Thread(target=lambda: (time.sleep({delay}), os.kill(os.getpid(), signal.{name})), daemon=True).start())
print("done")
''')


def test_a_second_interrupt_while_the_interpreter_ends_ends_the_process():
    ends_well(INTERRUPTED_AT_THE_END + '''
app.create("never", Never)
has_begun.wait()
threading.Thread(target=interrupt, daemon=True).start()
try:
    app.close()
except KeyboardInterrupt:
    print("done", flush=True)
''', code=-2)


def test_daemon_threads_open_more_when_the_script_ends():
    ends_well('''
    def work():
        while True:
            try:
                kept.append(ticking())
                del kept[:-8]
            except runnel.Error:
                pass

    kept = []
    for _ in range(4):
        threading.Thread(target=work, daemon=True).start()
    time.sleep(0.3)
    print("done")
    ''')
