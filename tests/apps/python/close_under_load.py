"""16 threads call whatever an application in this process has, and close it at random; so does the collector.

    python close_under_load.py [CLOSES [SEED]]

Without CLOSES for 15 s.

Nothing is asserted but that the process ends by itself, and that only errors are raised that a user may see.
"""

import asyncio
import collections
import contextlib
import faulthandler
import gc
import os
import random
import sys
import tempfile
import threading
import time
import weakref

import runnel

THREADS = 16
SEEN = (runnel.Error, ValueError, TypeError, BufferError, TimeoutError, KeyError)
MODULES = collections.deque(maxlen=12)  # those made last, for threads beside their cycles


class Collects:
    """A number that has the collector run, and another thread, while an extension holds whatever it holds."""

    def __float__(self):
        collect()
        if random.random() < 0.1:
            time.sleep(random.random() / 50)
        return 1.5


def collect():
    if random.random() < 0.03:
        gc.collect(random.randrange(3))


class Counter(runnel.Module):
    period = 0.002
    step = runnel.Parameter(1.0)
    out = runnel.Output("double")
    pose = runnel.Output("Pose2")
    many = runnel.Output("double[]")
    wish = runnel.Input("Twist2")
    other = runnel.Client("double", {"to": "double"})

    def __init__(self):
        self.count = 0.0
        self.kept = []
        collect()

    def prepare(self):
        MODULES.append(self)
        collect()

    @runnel.service
    def reset(self, to: float = 0) -> float:
        collect()
        self.count = to
        return to

    @runnel.service(activity=True)
    def long(self, activity, steps: int = 3) -> float:
        for i in range(steps):
            activity.report(i / steps, "counting")
            collect()
            if activity.is_abort_asked:
                break
        return 1.0

    def update(self):
        self.count += self.step
        self.out.publish(Collects())
        self.pose.publish(x=self.count, y=Collects())
        self.many.publish([self.count] * 20)
        self.wish.new()
        self.other.send(1.0)
        leave_garbage(self)
        collect()


def look_at(call):
    call.is_done, call.status, call.reply, call.error, call.progress, call.doing
    call.abort()
    leave_garbage(call)


def leave_garbage(what):
    """A cycle that keeps it until the collector comes."""
    circle = [what]
    circle.append(circle)


class Load:
    def __init__(self, closes, seed):
        self.left = closes or sys.maxsize
        self.end = time.monotonic() + (1e9 if closes else 15)
        self.seed = seed
        self.lock = threading.Lock()
        self.all = weakref.WeakValueDictionary()
        self.apps = [self.opened(i) for i in range(3)]
        self.wrong = []

    def opened(self, i):
        is_simulated = random.random() < 0.6
        app = runnel.compose(f"load{i}", clock="simulated" if is_simulated else "real", speed=0 if is_simulated else None,
                             control=random.random() < 0.2)
        self.all[id(app)] = app
        app.thread("control", 0.005)
        app.create("gate", "motion/command_gate")
        app.create("one", Counter)
        app.create("two", Counter, step=2.0)
        app.connect("/gate/allowed", "/one/wish")
        if random.random() < 0.5:
            app.start()
        app.keeps = [app.close]  # a cycle
        return app

    def close_one(self):
        at = random.randrange(len(self.apps))
        app = self.apps[at]
        how = random.random()
        if how < 0.5:
            app.close()
        elif how < 0.7:
            others = [threading.Thread(target=app.close) for _ in range(2)]
            for each in others:
                each.start()
            app.close()
            for each in others:
                each.join()
        del app  # else the collector ends it
        new = self.opened(at)
        with self.lock:
            self.apps[at] = new
            self.left -= 1

    def close_rest(self):
        """Those that nobody closes: calls of a service wait for ever where the cycles have been paused."""
        is_over = self.left <= 0 or time.monotonic() > self.end
        for each in self.all.valuerefs():
            app = each()
            if app is not None and (is_over or app not in self.apps):
                with contextlib.suppress(*SEEN):
                    app.close()

    def work(self, number):
        chance = random.Random(self.seed * 100 + number)
        names = [name for name in dir(self) if name.startswith("do_")]
        while self.left > 0 and time.monotonic() < self.end:
            try:
                if chance.random() < 0.02:
                    self.close_one()
                else:
                    getattr(self, chance.choice(names))(chance.choice(self.apps))
            except SEEN:
                pass
            except BaseException as unexpected:
                self.wrong.append(unexpected)
                raise
            collect()

    def path(self, kind=("out", "pose", "wish", "step")):
        return f"/{random.choice(('one', 'two', 'made'))}/{random.choice(kind)}"

    def do_read(self, app):
        value = app.read(self.path())
        leave_garbage(value)

    def do_get(self, app):
        app[self.path()]

    def do_set(self, app):
        app[self.path(("step",))] = random.random()

    def do_publish_by_hand(self, app):
        app.publish(random.choice(("/one/wish", "/gate/wanted")), {"forward": Collects()})

    def do_use_of_ports(self, app):
        """Of any application, also where another module is taking its place, and of modules that are gone."""
        module = random.choice(MODULES)
        for _ in range(5):
            random.choice((
                lambda: module.many.publish([Collects()] * 20),
                lambda: module.out.publish(Collects()),
                lambda: module.pose.publish(x=Collects(), y=module.wish.timestamp),
                lambda: module.wish.read() and module.wish.next(),
                lambda: module.other.send(Collects()),
                lambda: module.other.call(lambda call: call.reply, Collects()),
                lambda: look_at(module.other.begin(Collects())),
                lambda: module.out.publish_measured(0.0, Collects()),
                lambda: module.other.is_connected,
                lambda: module.step,
            ))()

    def do_release(self, app):
        app.release(random.choice((None, "/one/wish", "/gate/wanted")))

    def do_stop(self, app):
        app.stop()

    def do_block(self, app):
        app.block(self.path())

    def do_reader(self, app):
        reader = app.reader(self.path(("out", "pose")), queue=random.choice((0, 5)))
        reader.wait(random.random() / 20)
        list(reader)
        reader.read(), reader.timestamp, reader.publication_time, reader.dropped, reader.type
        leave_garbage(reader)

    def do_values(self, app):
        async def some():
            async for _ in app.values("/one/out", queue=3):
                if random.random() < 0.3:
                    return

        async def a_while():
            task = asyncio.ensure_future(some())
            await asyncio.sleep(random.random() / 100)
            task.cancel()
            await asyncio.gather(task, return_exceptions=True)

        asyncio.run(a_while())

    def do_writer(self, app):
        writer = app.writer("/two/wish")
        for _ in range(3):
            writer.publish(forward=Collects())
        leave_garbage(writer)

    def do_call(self, app):
        app.call("/one/reset", to=Collects(), timeout=0.05)

    def do_activity(self, app):
        app.call("/two/long", steps=2, timeout=0.05)

    def do_record(self, app):
        recording = app.record(f"run{threading.get_ident()}.mcap", ["/one/*"])
        recording.progress()
        if random.random() < 0.5:
            recording.close()
        leave_garbage(recording)

    def do_look(self, app):
        app.paths(), app.log(), app.events(), app.faults(), app.verdict(), repr(app), app.time, app.name, app.file, app.is_running

    def do_step(self, app):
        app.step(random.randrange(20))

    def do_run_for(self, app):
        app.run_for(random.random() / 10)

    def do_run(self, app):
        app.run(random.choice((0.05, 0.2)))

    def do_start(self, app):
        app.start()

    def do_quit(self, app):
        app.quit()

    def do_pause(self, app):
        app.pause(random.choice((None, "/two")))

    def do_resume(self, app):
        app.resume(random.choice((None, "/two")))

    def do_set_speed(self, app):
        app.set_speed(random.choice((0, 10)))

    def do_create(self, app):
        app.create("made", random.choice((Counter, "motion/command_gate")))

    def do_delete(self, app):
        app.delete("/made")

    def do_connect(self, app):
        app.connect("/gate/allowed", "/two/wish", queue=random.choice((0, 2)))

    def do_disconnect(self, app):
        app.disconnect("/gate/allowed", "/two/wish")

    def do_swap(self, app):
        app.swap("/two", Counter, step=3.0)

    def do_undo(self, app):
        app.undo()
        app.redo()

    def do_apply(self, app):
        app.apply("set /one/step 2")

    def do_assign(self, app):
        app.assign("/one", random.choice(("control", "")))

    def do_save(self, app):
        app.save(f"saved{threading.get_ident()}.xml", overwrite=True)

    def do_reload(self, app):
        app.reload()

    def do_thread(self, app):
        app.thread(f"thread{random.randrange(3)}", 0.01)

    def do_group(self, app):
        app.group("many")
        app.delete("many")

    def do_make(self, app):
        runnel.make("Pose2", x=Collects()).copy().plain()

    def do_read_recording(self, app):
        """Of one that others read, too."""
        assert len(self.recording.keys()) == 3
        series = self.recording[random.choice(("/one/out", "/one/pose"))]
        assert len(series) == len(series.values) > 0
        self.recording.about

    def do_remote(self, app):
        with runnel.connect(app.name, timeout=5.0) as far:
            far.get("/one/step"), far.read("/one/out"), far.set("/one/step", 2.0), far.ask("paths"), far.paths(), far.log(), far.faults()
            far.apply("set /one/step 2")
            random.choice((
                lambda: far.swap("/gate", "motion/command_gate"),
                lambda: (far.undo(), far.redo()),
                lambda: far.publish("/one/wish", {"forward": 1}),
                lambda: far.release("/one/wish"),
                lambda: (far.stop(), far.release()),
                lambda: far.block("/one/wish"),
                lambda: far.call("/one/reset", to=1.0, timeout=0.05),
                lambda: far.record(f"far{threading.get_ident()}.mcap").close(),
                lambda: (far.create("/far", "motion/command_gate"), far.connect("/gate/allowed", "/far/wanted"),
                         far.disconnect("/gate/allowed", "/far/wanted"), far.delete("/far")),
                lambda: (far.pause(), far.step(), far.set_speed(0), far.resume()),
                lambda: far.reload(),
                lambda: far.save(f"far{threading.get_ident()}.xml", overwrite=True),
                lambda: far.quit(),
            ))()


def recorded():
    with runnel.compose("recorded", clock="simulated") as app:
        app.create("one", Counter)
        with app.record("recorded.mcap", ["/one/*"]):
            app.run_for(1)
    return runnel.read("recorded.mcap")


def main(closes=0, seed=None):
    seed = int(seed) if seed is not None else random.randrange(10**6)
    print("seed", seed, flush=True)
    random.seed(seed)
    faulthandler.enable()
    os.chdir(tempfile.mkdtemp())
    sys.setswitchinterval(1e-4)
    load = Load(int(closes), seed)
    load.recording = recorded()
    threads = [threading.Thread(target=load.work, args=(i,)) for i in range(THREADS)]
    for each in threads:
        each.start()
    while any(each.is_alive() for each in threads):
        time.sleep(0.5)
        load.close_rest()
    print("closes", sys.maxsize - load.left if not int(closes) else closes)
    print("wrong", load.wrong[:1], flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
