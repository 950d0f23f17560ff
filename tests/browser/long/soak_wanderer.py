"""Drives ahead, and turns where something is near: for ever."""

import runnel


class Wanderer(runnel.Module):
    period = 0.05
    scan = runnel.Input("RangeScan", required=True)
    twist = runnel.Output("Twist2")
    distance = runnel.Parameter(0.6, unit="m", bounds=(0.2, 3.0))
    cycles = 0

    @runnel.service
    def count(self) -> int:
        """How many cycles it has run."""
        return self.cycles

    def update(self):
        self.cycles += 1
        scan = self.scan.new()
        if scan is None or scan.ranges.size == 0:
            return
        if scan.ranges.min() > self.distance:
            self.twist.publish(forward=0.4)
        else:
            self.twist.publish(turn=1.0)
