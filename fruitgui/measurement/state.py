"""The unknowns of a fit, and what is known of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F64
from fruitgui.measurement.evidence import Evidence
from fruitgui.measurement.shape import Shape, ball


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """A surface and where every view places it.

    Attributes:
        shape: the surface about its centre; `shape.matrix` acts on the belt frame's axes.
        body: (3, 3) rotation from the ball's own frame into the belt frame.
        centre_m: (3,) in the belt frame, at the middle of the track.
        path_m: (V, 3) what the belt had carried it by at each view.
        offset_m: (S, 3) of each sensor.
        edge_px: (S, 2) how much each sensor fattens edges along its picture's x and y.
        shift_m: (V, 3) of each view, beyond all that.
        turn: (V, 3, 3) from how it lay in the view to how it lies.
        turned: whether any view is turned.
        along_m: (V, M) from each sample along its sight to the surface.
    """

    shape: Shape
    body: F64
    centre_m: F64
    path_m: F64
    offset_m: F64
    edge_px: F64
    shift_m: F64
    turn: F64
    turned: bool
    along_m: F64

    def place_m(self, evidence: Evidence) -> F64:
        """Return the centre (V, 3) in every view."""
        return np.asarray(self.centre_m + self.path_m + self.offset_m[evidence.sensor] + self.shift_m)


def first_state(evidence: Evidence, path_m: F64, edge_px: float) -> State:
    """Return a ball of the height seen, where the views' centres are."""
    views, sensors = len(evidence.samples_m), len(evidence.sensors)
    centre = np.median(evidence.centre_m - path_m, axis=0)
    centre[2] = 0.5 * evidence.height_m
    return State(
        shape=ball(max(0.5 * evidence.height_m, 5e-3)),
        body=np.eye(3),
        centre_m=centre,
        path_m=path_m,
        offset_m=np.zeros((sensors, 3)),
        edge_px=np.full((sensors, 2), edge_px),
        shift_m=np.zeros((views, 3)),
        turn=np.tile(np.eye(3), (views, 1, 1)),
        turned=False,
        along_m=np.zeros(evidence.used.shape),
    )
