"""What holds a shift, and how firmly: fruit that both see, straight lines, and the belt's own texture."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from fruitgui.calibration import across, borders, fine, texture
from fruitgui.calibration import lines as rails
from fruitgui.calibration.fine import Fit
from fruitgui.calibration.flat import Shift
from fruitgui.calibration.lines import Turn
from fruitgui.calibration.ready import Ready
from fruitgui.frame import F64

SURELY_SAME_RAD = float(np.radians(0.3))
CONTRADICTION = 25.0
"""Squared, normalised difference between fruit and texture beyond which they speak of different shifts (3 degrees of
freedom, 1.5e-5 of true ones)."""


@dataclass(frozen=True, slots=True, eq=False)
class Held:
    """A shift with all that holds it taken together.

    Attributes:
        shift: source belt frame → target belt frame.
        centre_m: (2,) where its turn is taken about, target's frame.
        covariance: (3, 3) of (x, y, θ about the centre).
        textured: whether the belt's texture bears it out.
    """

    shift: Shift
    centre_m: F64
    covariance: F64
    textured: bool

    @property
    def position_std_m(self) -> float:
        """Standard deviation of the place at the centre."""
        return float(np.sqrt(self.covariance[0, 0] + self.covariance[1, 1]))

    @property
    def heading_std_rad(self) -> float:
        """Standard deviation of the heading."""
        return float(np.sqrt(self.covariance[2, 2]))

    @property
    def about_origin(self) -> F64:
        """The (3, 3) covariance of (x, y, θ about the target belt frame's origin)."""
        return carried(self.covariance, self.centre_m, np.zeros(2))


def carried(covariance: F64, centre_m: F64, to_m: F64) -> F64:
    """Carry the (3, 3) covariance of (x, y, θ about a centre) to a turn about another point."""
    arm = to_m - centre_m
    J = np.eye(3)
    J[0, 2], J[1, 2] = -arm[1], arm[0]
    return np.asarray(J @ covariance @ J.T)


def held(source: Ready, target: Ready, fit: Fit) -> Held:
    """Return a fit, its heading settled by lines, and bettered by edges and the belt's texture, where these speak."""
    return _by_texture(source, target, _by_edges(source, target, _by_lines(source, target, fit)))


def _by_lines(source: Ready, target: Ready, fit: Fit) -> Held:
    """Return a fit with its heading settled by borders or rails that both see.

    With the heading settled, the shift is fitted anew: what the fruit's own heading erred would else stay in it. A
    line that contradicts the fruit by more than four standard deviations, and more than lines that lie so near each
    other ever do, is not the same line.
    """
    covariance = fine.covariance(source.relief, target.relief, fit)
    alone = Held(fit.shift, fit.matched.centre_m, covariance, textured=False)
    turn = _turn(source, target, fit.shift)
    if turn is None or turn.turn_rad**2 > max(16 * (covariance[2, 2] + turn.std_rad**2), SURELY_SAME_RAD**2):
        return alone
    share = covariance[2, 2] / (covariance[2, 2] + turn.std_rad**2)
    turned = fit.shift.about(fit.matched.centre_m, np.array([0.0, 0.0, share * turn.turn_rad]))
    anew = fine.settle(source.relief, target.target, turned)
    if anew is None:
        return alone
    spread = np.zeros((3, 3))
    spread[:2, :2] = fine.covariance(source.relief, target.relief, anew, turning=False)[:2, :2]
    spread[2, 2] = (1.0 - share) * covariance[2, 2]
    return Held(anew.shift, anew.matched.centre_m, spread, textured=False)


def _turn(source: Ready, target: Ready, shift: Shift) -> Turn | None:
    """Return what straight things say of a heading: borders in the colour pictures, else rails in the depth."""
    seen = borders.turn_between(source.borders, target.borders, shift)
    return rails.turn_between(source.lines, target.lines, shift) if seen is None else seen


def _by_edges(source: Ready, target: Ready, so_far: Held) -> Held:
    """Return the mean, by covariance, of a shift and where edges that both see say it lies across them."""
    said = across.across(
        (source.relief, source.brinks), (target.relief, target.brinks), so_far.shift, so_far.position_std_m
    )
    if said is None:
        return so_far
    arm = said.at_m - so_far.centre_m
    row = np.array([*said.normal, said.normal @ np.array([-arm[1], arm[0]])])
    spread = so_far.covariance @ row
    variance = float(row @ spread) + said.std_m**2
    if said.gap_m**2 > CONTRADICTION * variance:
        return so_far
    shift = so_far.shift.about(so_far.centre_m, spread * said.gap_m / variance)
    return replace(so_far, shift=shift, covariance=so_far.covariance - np.outer(spread, spread) / variance)


def _by_texture(source: Ready, target: Ready, so_far: Held) -> Held:
    """Return the mean, by covariance, of a shift and what the belt's texture says of it, unless they contradict."""
    said = texture.alike(source.skin, target.skin, so_far.shift)
    if said is None:
        return so_far
    before = carried(so_far.covariance, so_far.centre_m, said.centre_m)
    gain = before @ np.linalg.inv(before + said.covariance)
    if said.step @ np.linalg.solve(before + said.covariance, said.step) > CONTRADICTION:
        return so_far
    shift = so_far.shift.about(said.centre_m, gain @ said.step)
    return Held(shift, said.centre_m, (np.eye(3) - gain) @ before, textured=True)
