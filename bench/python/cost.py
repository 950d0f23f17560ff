"""What values cost in Python: calls per second, bytes copied. Started by hand, after building the package:

    PYTHONPATH=BUILD/lib/python3/dist-packages /usr/bin/python3 bench/python/cost.py
"""

import time
import tracemalloc

import numpy

import runnel


def per_call(work, seconds=0.5):
    """The best of five, in us."""
    count, best = 1, float("inf")
    while True:
        begin = time.perf_counter()
        for _ in range(count):
            work()
        took = time.perf_counter() - begin
        if took > seconds / 10:
            break
        count *= 2
    for _ in range(5):
        begin = time.perf_counter()
        for _ in range(count):
            work()
        best = min(best, (time.perf_counter() - begin) / count)
    return best * 1e6


def allocated(work):
    """Bytes that Python and NumPy allocate at most meanwhile."""
    tracemalloc.start()
    kept = work()
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    del kept
    return peak


class Camera(runnel.Module):
    number = runnel.Input("double")
    picture = runnel.Input("Image")
    pose = runnel.Input("Pose2")
    out = runnel.Output("double")

    def update(self):
        pass


app = runnel.compose("cost", clock="simulated")
app.create("camera", Camera)
pixels = numpy.zeros((1024, 1024 * 6), "u1")  # 6 MiB
writers = {name: app.writer(f"/camera/{name}") for name in ("number", "picture", "pose")}
print(f"publish a number            {per_call(lambda: writers['number'].publish(1.0)):10.2f} us")
print(f"publish a Pose2 by fields   {per_call(lambda: writers['pose'].publish(x=1.0, y=2.0, heading=0.0)):10.2f} us")
picture = dict(width=2048, height=1024, encoding="rgb8", row_stride=6144, data=pixels.ravel())
print(f"publish a 6 MB picture      {per_call(lambda: writers['picture'].publish(**picture)):10.2f} us")


class Source(runnel.Module):
    number = runnel.Output("double")
    picture = runnel.Output("Image")
    pose = runnel.Output("Pose2")

    def update(self):
        self.number.publish(1.0)
        self.picture.publish(**picture)
        self.pose.publish(x=1.0)


app.create("source", Source)
app.step(3)
readers = {name: app.reader(f"/source/{name}") for name in ("number", "picture", "pose")}
app.step(3)
print(f"read a number               {per_call(readers['number'].read):10.2f} us")
print(f"read a Pose2                {per_call(readers['pose'].read):10.2f} us")
pose = readers["pose"].read()
print(f"a field of it               {per_call(lambda: pose.x):10.2f} us")
as_array = lambda: runnel.image(readers["picture"].read())
print(f"read a 6 MB picture as array{per_call(as_array):10.2f} us, {allocated(as_array)} bytes allocated")
array = as_array()
assert array.shape == (1024, 2048, 3)
print(f"numpy copy of it            {per_call(array.copy):10.2f} us, {allocated(array.copy)} bytes allocated")
print(f"cycle with a module in Python {per_call(lambda: app.step(1)):8.2f} us (one of them publishes 6 MB)")
app.delete("/source")
print(f"a cycle of one that does nothing {per_call(lambda: app.step(1)):5.2f} us")
app.close()
