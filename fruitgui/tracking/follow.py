"""Following the belt through stops, starts and changes of speed."""

from __future__ import annotations

import math
from typing import Protocol

import numpy as np

from fruitgui.frame import F64, Bools
from fruitgui.geometry.rig import Rig
from fruitgui.tracking.belt import BeltMotion
from fruitgui.tracking.field import FieldOfView
from fruitgui.tracking.gap import GAP_S, ON_SHARE, PLACE_STD_M, Gap
from fruitgui.tracking.measured import Measured, look_distance, variances
from fruitgui.tracking.voting import ALIKE, CommonShift, common_shift

FASTEST_M_S = 1.2
"""No belt that people load by hand runs faster."""

STEADY_M_S2 = 0.15
TURNING_M_S2 = 4.0
"""Accelerations (one standard deviation) of a belt that runs, and of one that stops or starts."""

RUNNING_SHARE = 0.4
"""Below this share of the top speed a belt counts as stopped, or nearly."""

RUN_STD_M = 0.005
"""What a way measured by fruit that come and go is uncertain by, pose errors included."""

SIDEWAYS_M_S2 = 0.01
SAME_PLACE_STD_M = 0.009
PLACE_FLOOR_M = 0.003
"""Two sensors' centres of one fruit differ by some millimetres, and all of one capture's alike."""


_EYE = np.eye(2)


class BeltModel(Protocol):
    """How the belt's displacement between two captures is known."""

    def advance(self, time_s: float) -> F64:
        """Return the predicted displacement (3,) since the last capture."""

    def correct(self, position_m: F64, variance_m2: F64, looks: F64, fit: Bools, seen: Measured) -> F64:
        """Return what the prediction was wrong by, (3,), judged by tracks (n) and the views."""

    def motion(self) -> BeltMotion:
        """Return the velocity now."""

    def mean_motion(self) -> BeltMotion:
        """Return the mean velocity while it ran."""

    def travelled_m(self) -> F64:
        """Return the displacement (3,) since the beginning."""


class ConstantBelt:
    """A belt that runs as it was told to (the source's assumption)."""

    def __init__(self, motion: BeltMotion, time_s: float) -> None:
        self._motion = motion
        self._time_s = time_s
        self._travelled: F64 = np.zeros(3)

    def advance(self, time_s: float) -> F64:
        """Return velocity times elapsed time, (3,)."""
        step = self._motion.velocity_m_s * (time_s - self._time_s)
        self._time_s = time_s
        self._travelled = self._travelled + step
        return np.asarray(step)

    def correct(self, position_m: F64, variance_m2: F64, looks: F64, fit: Bools, seen: Measured) -> F64:  # noqa: ARG002 - the protocol
        """Return nothing: the speed is what it was said to be."""
        return np.zeros(3)

    def motion(self) -> BeltMotion:
        """Return the velocity that was given."""
        return self._motion

    def mean_motion(self) -> BeltMotion:
        """Return the velocity that was given."""
        return self._motion

    def travelled_m(self) -> F64:
        """Return the displacement (3,) since the beginning."""
        return self._travelled


class BeltFollower:
    """Tracks the belt's displacement and velocity on its own plane from what all fruit do in common.

    A Kalman filter over (displacement, velocity), each (2,) on the belt; what it
    measures is the shift on which most fruit of a capture agree. A shift that a
    steady belt could not have made loosens the velocity for that capture.
    """

    def __init__(self, rig: Rig, motion: BeltMotion, time_s: float) -> None:
        self._field = FieldOfView.of(rig)
        self._frame = rig.belt_frame()
        self._back: F64 = np.ascontiguousarray(self._frame.rotation[:2].T)
        self._time_s = time_s
        self._measured_s = time_s
        self._velocity: F64 = self._frame.turn(motion.velocity_m_s)[:2]
        turned = self._frame.rotation @ motion.covariance @ self._frame.rotation.T
        self._covariance = np.zeros((4, 4))
        self._covariance[2:, 2:] = turned[:2, :2] + 1e-8 * np.eye(2)
        self._top_speed = float(np.linalg.norm(self._velocity))
        self._heading: F64 | None = self._velocity / self._top_speed if self._top_speed > 0.02 else None
        self._travelled: F64 = np.zeros(2)
        self._ran_m: F64 = np.zeros(2)
        self._ran_s = 0.0
        self._marked: F64 = np.zeros(2)

    def mean_motion(self) -> BeltMotion:
        """Return the mean velocity between captures that showed the belt running, reference frame."""
        if self._ran_s < 0.5:
            return self.motion()
        std = RUN_STD_M / max(float(np.linalg.norm(self._ran_m)), RUN_STD_M)
        mean = self._ran_m / self._ran_s
        spread = (std * float(np.linalg.norm(mean))) ** 2
        return BeltMotion(self._back @ mean, spread * self._back @ self._back.T)

    def motion(self) -> BeltMotion:
        """Return the velocity now, reference frame."""
        return BeltMotion(self._back @ self._velocity, self._back @ self._covariance[2:, 2:] @ self._back.T)

    def travelled_m(self) -> F64:
        """Return the displacement (3,) since the beginning, reference frame."""
        return self._back @ self._travelled

    def advance(self, time_s: float) -> F64:
        """Return the predicted displacement (3,) since the last capture, reference frame."""
        duration = time_s - self._time_s
        self._time_s = time_s
        step = self._velocity * duration
        self._travelled = self._travelled + step
        F = np.eye(4)
        F[0, 2] = F[1, 3] = duration
        self._covariance = F @ self._covariance @ F.T + self._noise(abs(duration), STEADY_M_S2)
        return self._back @ step

    def _noise(self, duration_s: float, acceleration_m_s2: float) -> F64:
        """Return the (4, 4) noise of a random acceleration held for `duration_s`, less of it sideways."""
        across = _EYE * acceleration_m_s2**2
        if self._heading is not None:
            along = self._heading[:, None] * self._heading
            across = along * acceleration_m_s2**2 + (_EYE - along) * SIDEWAYS_M_S2**2
        far, fast = 0.5 * duration_s**2, duration_s
        Q = np.empty((4, 4))
        Q[:2, :2], Q[2:, 2:] = far * far * across, fast * fast * across
        Q[:2, 2:] = Q[2:, :2] = far * fast * across
        return Q

    def correct(self, position_m: F64, variance_m2: F64, looks: F64, fit: Bools, seen: Measured) -> F64:
        """Return what the displacement was mispredicted by, (3,).

        Judged by the views and by those of n tracks that are fit for it: positions (n, 3), their variances per
        axis (n,), looks (n, 5).
        """
        usable = np.flatnonzero(~seen.cut) if (~seen.cut).any() else np.arange(len(seen))
        tracks = np.flatnonzero(fit)
        if not len(usable) or not len(tracks):
            return np.zeros(3)
        here = self._frame.apply(seen.position_m[usable])[:, :2]
        there = self._frame.apply(position_m[tracks])[:, :2]
        residual = here[None] - there[:, None]
        likeness = np.exp(-0.5 * np.minimum(look_distance(looks[tracks], seen.looks[usable]), 12.0))
        std = np.sqrt(variance_m2[tracks][:, None] + variances(seen.covariance_m2)[usable][None] + PLACE_FLOOR_M**2)
        admissible = self._admissible(residual)
        before = self._travelled.copy()
        if self._time_s - self._measured_s < GAP_S:
            self._take(common_shift(residual, std, likeness, admissible, self._bonus))
        else:
            way = self._travelled - self._marked
            alike = admissible & (likeness > ALIKE)
            self._take_after(
                Gap(
                    self._field, seen.sensor, self._back, way,
                    position_m[tracks], seen.position_m[usable], residual, std, alike,
                ),
                likeness,
            )  # fmt: skip
        return self._back @ (self._travelled - before)

    def _take_after(self, gap: Gap, likeness: F64) -> None:
        """Take what the fruit of a capture after a gap agree on, or that the belt went on where that is likelier."""
        found = common_shift(gap.residual_m, gap.std_m, likeness, gap.alike, gap.prior)
        on_votes = float(gap.prior(np.zeros((1, 2)))[0])
        if found is not None and found.votes + float(gap.prior(found.shift_m[None])[0]) > on_votes:
            self._take(found)
            return
        self._measured_s, self._marked = self._time_s, self._travelled.copy()
        std_m = ON_SHARE * float(np.linalg.norm(gap.way_m)) + PLACE_STD_M
        std_m_s = ON_SHARE * float(np.linalg.norm(self._velocity)) + 0.01
        self._covariance = np.diag([std_m**2, std_m**2, std_m_s**2, std_m_s**2])

    def _admissible(self, residual_m: F64) -> Bools:
        """Tell which residuals (n, m, 2) a belt could have made since it was last measured."""
        duration = max(self._time_s - self._measured_s, 0.0)
        slack = 3.0 * SAME_PLACE_STD_M
        if self._heading is None:
            return np.asarray(np.linalg.norm(residual_m, axis=2) < FASTEST_M_S * duration + slack)
        along = residual_m @ self._heading
        across = np.abs(residual_m @ np.array([-self._heading[1], self._heading[0]]))
        speed = float(self._velocity @ self._heading)
        fastest = min(FASTEST_M_S, 1.3 * max(self._top_speed, speed) + 0.1)
        low, high = -max(speed, 0.0) * duration - slack, max(fastest - speed, 0.0) * duration + slack
        return np.asarray((across < slack) & (along > low) & (along < high))

    def _bonus(self, residual_m: F64) -> F64:
        """Return prior votes (k,) for each of k residuals: a belt mostly goes on as it did, or has just stopped."""
        precise = np.linalg.inv(self._covariance[:2, :2] + SAME_PLACE_STD_M**2 * _EYE)
        return np.asarray(0.8 * np.exp(-0.5 * ((residual_m @ precise) * residual_m).sum(axis=1)))

    def _take(self, found: CommonShift | None) -> None:
        """Update displacement and velocity by a common shift; loosen the velocity first if it must have changed."""
        if found is None:
            return
        duration = max(self._time_s - self._measured_s, 1e-3)
        self._measured_s = self._time_s
        R = (found.std_m**2 + PLACE_FLOOR_M**2) * _EYE
        S = self._covariance[:2, :2] + R
        if float(found.shift_m @ np.linalg.solve(S, found.shift_m)) > 12.0:
            self._covariance = self._covariance + self._noise(duration, self._turning(found.shift_m, duration))
            S = self._covariance[:2, :2] + R
        K = np.linalg.solve(S, self._covariance[:2]).T
        change = K @ found.shift_m
        self._travelled = self._travelled + change[:2]
        self._velocity = self._velocity + change[2:]
        self._mark(duration)
        P = self._covariance - K @ S @ K.T
        self._covariance = 0.5 * (P + P.T)
        self._remember_heading()

    def _mark(self, duration_s: float) -> None:
        """Add the way since the last measurement to that which the belt ran."""
        way = self._travelled - self._marked
        self._marked = self._travelled.copy()
        if duration_s < 1.0 and math.hypot(*way) > RUNNING_SHARE * self._top_speed * duration_s:
            self._ran_m = self._ran_m + way
            self._ran_s += duration_s

    def _turning(self, shift_m: F64, duration_s: float) -> float:
        return max(TURNING_M_S2, 2.0 * float(np.linalg.norm(shift_m)) / duration_s**2)

    def _remember_heading(self) -> None:
        speed = math.hypot(*self._velocity)
        std = math.sqrt(self._covariance[2, 2] + self._covariance[3, 3])
        if speed > 0.03 and std < 0.15 * speed:
            self._heading = self._velocity / speed
            self._top_speed = max(self._top_speed, speed)
