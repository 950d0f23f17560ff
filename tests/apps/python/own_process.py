"""Scripts in processes of their own, which may end as they like."""

import signal
import subprocess
import sys
import textwrap

BEGIN = '''
import faulthandler, gc, os, signal, sys, threading, time
import runnel
faulthandler.enable()


def ticking(make=None, clock="real", start=True):
    class Tick(runnel.Module):
        period = 0.002
        step = runnel.Parameter(1.0)
        out = runnel.Output("double")
        wish = runnel.Input("Twist2")

        @runnel.service
        def reset(self, to: float = 0) -> float:
            return to

        def update(self):
            self.out.publish(1.0)

    Tick.__qualname__ = "Tick"
    globals()["Tick"] = Tick
    app = runnel.compose("ticking", clock=clock)
    app.thread("control", 0.005)
    app.create("gate", "motion/command_gate")
    app.create("tick", make or Tick)
    if start:
        app.start()
    return app


def in_threads(count, work):
    threads = [threading.Thread(target=work) for _ in range(count)]
    for each in threads:
        each.start()
    return threads
'''


def hear_interrupts():
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # what a shell starts in the background begins by ignoring them


def ends_well(text, *arguments, code=0):
    done = subprocess.run([sys.executable, "-c", BEGIN + textwrap.dedent(text), *arguments], capture_output=True, text=True, timeout=120,
                          preexec_fn=hear_interrupts)
    assert (done.returncode, done.stdout) == (code, "done\n"), f"{done.returncode}: {done.stdout}{done.stderr}"
    return done.stderr
