# %% [markdown]
# # A module in Python
# A class with ports and parameters drives the robot of an application that is composed here.

# %%
import numpy
import runnel


class Wanderer(runnel.Module):
    """Drives ahead, and turns where something is near."""

    period = 0.05
    scan = runnel.Input("RangeScan", required=True)
    twist = runnel.Output("Twist2")
    distance = runnel.Parameter(0.6, unit="m", bounds=(0.2, 3.0), description="what is nearer makes it turn")

    def update(self):
        scan = self.scan.new()
        if scan is None or scan.ranges.size == 0 or numpy.isnan(scan.ranges).any():
            return  # nobody knows what is there: the drive stands when its time-out is over
        if scan.ranges.min() > self.distance:
            self.twist.publish(forward=0.4)
        else:
            self.twist.publish(turn=1.0)


# %%
app = runnel.compose("wander", clock="simulated")
app.thread("control", 0.05)
app.create("world", "simulation/world", world="rooms")
app.create("laser", "simulation/laser")
app.create("wanderer", Wanderer, distance=0.7)
app.create("drive", "motion/differential_drive")
app.connect("/world/scene", "/laser/scene")
app.connect("/world/pose", "/laser/pose")
app.connect("/laser/scan", "/wanderer/scan")
app.connect("/wanderer/twist", "/drive/twist")
app.connect("/drive/wheels", "/world/wheels")

# %%
app.run_for(30)
print(app.read("/world/pose"), app.faults())

# %% [markdown]
# Parameters are turned while it drives, and what was changed last is taken back.

# %%
app["/wanderer/distance"] = 1.0
app.run_for(5)
app.undo()
print(app["/wanderer/distance"], "m")
app.close()
