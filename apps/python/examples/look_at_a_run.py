# %% [markdown]
# # A run, looked at
# A robot finds its way through three rooms, in simulated time. What the ports publish is recorded, and drawn.

# %%
import pathlib
import sys

import runnel

xml = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "xml")
app = runnel.load(xml / "apps/bug_demo.xml", speed=0, record="run.mcap")
app.run()
print(app.verdict()[0])

# %% [markdown]
# The newest values are objects; a scan's ranges are a NumPy array that looks at what the laser has published.

# %%
pose, scan = app.read("/world/pose"), app.read("/laser/scan")
print(pose, scan.ranges.min(), "m")
app.close()

# %%
recording = runnel.read("run.mcap")
series = recording["/world/pose"]
print(series, recording.about["clock"])
try:
    print(series.frame().describe())
except ImportError:
    print("pandas is not installed")

# %%
try:
    from matplotlib import pyplot

    axes = runnel.plot.way(series, label="the way")
    runnel.plot.scan(scan, pose, axes=axes, label="the last scan")
    axes.legend()
    pyplot.savefig("way.png")
except ImportError:
    print("matplotlib is not installed")
