"""What fruit usually are, as widths of Gaussians: nearly round about one axis, smooth, near where they should be."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F64
from fruitgui.measurement.harmonics import basis
from fruitgui.measurement.shape import Shape

ROUND_SIGMA = 0.08
"""Spread of the logarithm of the ratio of the two axes across the axis of revolution: oranges to flat mangoes."""

ASPECT_SIGMA = 0.4
"""Spread of the logarithm of length over breadth: from flat onions to bananas."""

SIZE_SIGMA = 0.7
"""Spread of the logarithm of the mean radius about half the height seen: nothing, but enough when all else fails."""

ZONAL_SIGMA = {3: 0.04, 4: 0.026, 5: 0.016, 6: 0.012}
"""Spread of the dents that turn about the axis unchanged (necks of pears, hollows of apples), by degree."""

UNEVEN_SIGMA = {3: 0.006, 4: 0.004, 5: 0.0027, 6: 0.0018}
"""Spread of each of the other dents, by degree: a few per cent of the radius in all."""

HEIGHT_SIGMA_M = 0.7e-3
"""How far a sensor's or a view's heights may be off after they were taken from its own belt."""


FATTENING_PX, FATTENING_SIGMA_PX, FATTENING_UNEVEN_PX = 0.7, 0.8, 0.3
"""Fattening of edges: its mean, its spread between sensors, and the spread of its difference between x and y."""


def _edge_information() -> F64:
    """Return the information (5, 5) on a sensor's height and edges; on its shift along the belt there is none yet."""
    information = np.zeros((5, 5))
    information[2, 2] = 1.0 / HEIGHT_SIGMA_M**2
    information[3:, 3:] = 0.25 / FATTENING_SIGMA_PX**2
    information[3:, 3:] += np.array([[1.0, -1.0], [-1.0, 1.0]]) / FATTENING_UNEVEN_PX**2
    information.setflags(write=False)
    return information


EDGE_INFORMATION: F64 = _edge_information()

ROCKING_SIGMA_M = 1.5e-3
"""How far the centre of a fruit rises and falls as it rocks."""


@dataclass(frozen=True, slots=True, eq=False)
class Prior:
    """Information (1/σ²) on the unknowns of a fit.

    Attributes:
        axes: (6, 6) on the logarithm of the ellipsoid's stretch, order of `shape.SIX`.
        dents: (K,) on the harmonics' weights.
        log_radius: logarithm of the radius expected, metres.
        view_information: (3,) on each view's own shift, belt frame, or (6,) on its shift and its turn.
    """

    axes: F64
    dents: F64
    log_radius: float
    view_information: F64

    def of_sensor(self, offset_sigma_m: float, offset_m: F64, edge_px: F64) -> tuple[F64, F64]:
        """Return information (5, 5) and gradient (5,) on one sensor's shift and its edges' fattening."""
        information = EDGE_INFORMATION.copy()
        information[0, 0] = information[1, 1] = 1.0 / offset_sigma_m**2
        return information, information @ np.concatenate([offset_m, edge_px - FATTENING_PX])

    def add(self, H: F64, b: F64, shape: Shape, body: F64) -> None:
        """Add the prior of the shape to the normal equations."""
        count = len(self.dents)
        log = log_axes(shape, body)
        log[:3] -= self.log_radius
        H[:6, :6] += self.axes
        b[:6] += self.axes @ log
        index = np.arange(6, 6 + count)
        H[index, index] += self.dents
        b[index] += self.dents * shape.weights


def log_axes(shape: Shape, body: F64) -> F64:
    """Return the logarithm of the ellipsoid's semi-axes as a symmetric matrix's six entries, in the body's frame."""
    values, vectors = np.linalg.eigh(shape.matrix @ body)
    log = -(vectors * np.log(np.abs(values))) @ vectors.T
    return np.array([log[0, 0], log[1, 1], log[2, 2], log[0, 1], log[0, 2], log[1, 2]])


def shape_prior(
    degree: int, shift_sigma_m: float, radius_m: float, *, axis_known: bool, turn_sigma_rad: float = 0.0
) -> Prior:
    """Return the prior for a fruit of about a radius and harmonics up to `degree`.

    Args:
        degree: below three there are none.
        shift_sigma_m: of each view's own shift along the belt.
        radius_m: expected, very loosely.
        axis_known: the body's z axis is that of revolution.
        turn_sigma_rad: of each view's own turn; at zero there is none.
    """
    across = ROUND_SIGMA if axis_known else ASPECT_SIGMA
    rows = np.array(
        [
            np.array([1.0, 1.0, 1.0, 0.0, 0.0, 0.0]) / (3.0 * SIZE_SIGMA),
            np.array([1.0, -1.0, 0.0, 0.0, 0.0, 0.0]) / across,
            np.array([-0.5, -0.5, 1.0, 0.0, 0.0, 0.0]) / ASPECT_SIGMA,
            np.array([0.0, 0.0, 0.0, 2.0, 0.0, 0.0]) / across,
            np.array([0.0, 0.0, 0.0, 0.0, 2.0, 0.0]) / ASPECT_SIGMA,
            np.array([0.0, 0.0, 0.0, 0.0, 0.0, 2.0]) / ASPECT_SIGMA,
        ]
    )
    dents = np.zeros(0)
    if degree >= 3:
        harmonics = basis(degree)
        sigma = [
            (ZONAL_SIGMA if m == 0 else UNEVEN_SIGMA)[int(n)]
            for n, m in zip(harmonics.degree, harmonics.order, strict=True)
        ]
        dents = np.array(sigma) ** -2.0
    view = [shift_sigma_m, shift_sigma_m, HEIGHT_SIGMA_M]
    if turn_sigma_rad:
        view = [shift_sigma_m, shift_sigma_m, ROCKING_SIGMA_M, *[turn_sigma_rad] * 3]
    return Prior(rows.T @ rows, dents, float(np.log(radius_m)), np.array(view) ** -2.0)
