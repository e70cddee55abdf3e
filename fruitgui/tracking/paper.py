"""The source's filter: one Kalman filter per fruit, the mean of the seen points, the closest pair.

Section 2.7 of the source, with R, T from the reference frame to the sensor:
S = R Σ_X Rᵀ + X̂_r Σ_ΔR X̂_rᵀ + Σ_ΔT,  K = Σ_X Rᵀ S⁻¹,  X ← X + K (Y - (R X̂ + T)),
Σ_X ← (I - K R) Σ_X. As printed it trusts the reference sensor wholly; the
centroid's own covariance is added to S.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from fruitgui.frame import F64, Bools, Ints
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.propagation import EntryErrors, entry_errors, independent_errors, stacked
from fruitgui.geometry.rig import Rig
from fruitgui.tracking.consider import pose_covariance
from fruitgui.tracking.measured import Measured
from fruitgui.tracking.presets import PaperPreset


def preset_errors(rig: Rig, preset: PaperPreset) -> dict[str, EntryErrors]:
    """Return the source's own values for every sensor but the reference, which is exact."""
    fixed = independent_errors(preset.rotation, preset.translation_m2)
    exact = independent_errors([0.0] * 9, [0.0] * 3)
    return {sensor: exact if sensor == rig.reference else fixed for sensor in rig.mounts}


def station_errors(rig: Rig) -> dict[str, EntryErrors]:
    """Return what this station's own calibration estimated, for the poses from the reference to each sensor."""
    posed = {
        sensor: Pose(mount.pose.rotation, mount.pose.translation_m, pose_covariance(rig, sensor))
        for sensor, mount in rig.mounts.items()
    }
    return {sensor: entry_errors(pose.inverse()) for sensor, pose in posed.items()}


class PaperFilter:
    """The positions of n fruit by the source's equations.

    Attributes:
        position_m: (n, 3) reference frame.
        position_covariance_m2: (n, 3, 3).
    """

    def __init__(self, rig: Rig, errors: Mapping[str, EntryErrors], process_m2: float) -> None:
        self._to_sensor = {sensor: mount.pose.inverse() for sensor, mount in rig.mounts.items()}
        self._errors = errors
        self._process_m2 = process_m2
        self._filters: list[Any] = []

    def __len__(self) -> int:
        return len(self._filters)

    @property
    def position_m(self) -> F64:
        """The (n, 3) estimated positions."""
        return np.array([one.x for one in self._filters], dtype=np.float64).reshape(-1, 3)

    @property
    def position_covariance_m2(self) -> F64:
        """The (n, 3, 3) covariances Σ_X."""
        return np.array([one.P for one in self._filters], dtype=np.float64).reshape(-1, 3, 3)

    def predict(self, duration_s: float, displacement_m: F64) -> None:
        """X ← X + V Δt, Σ_X ← Σ_X + Σ_η Δt / 0.1 s."""
        Q = np.eye(3) * self._process_m2 * abs(duration_s) / 0.1
        for one in self._filters:
            one.predict(u=displacement_m, B=np.eye(3), Q=Q)

    def shift(self, displacement_m: F64) -> None:
        """Move all fruit by a displacement (3,)."""
        for one in self._filters:
            one.x = one.x + displacement_m

    def innovations(self, tracks: Ints, views: Ints, seen: Measured) -> tuple[F64, F64]:
        """Return residuals (k, 3) and S (k, 3, 3) in the sensor's frame."""
        pose = self._to_sensor[seen.sensor]
        position = self.position_m[tracks]
        residual = pose.apply(seen.position_m[views]) - pose.apply(position)
        R = pose.rotation
        spread = self.position_covariance_m2[tracks] + seen.covariance_m2[views]
        noise = np.array([self._pose_noise(x, seen.sensor) for x in position]).reshape(-1, 3, 3)
        return residual, R @ spread @ R.T + noise

    def _pose_noise(self, position_m: F64, sensor: str) -> F64:
        X, errors = stacked(position_m), self._errors[sensor]
        crossed = X @ errors.cross_m
        return np.asarray(X @ errors.rotation @ X.T + errors.translation_m2 + crossed + crossed.T)

    def update(self, tracks: Ints, views: Ints, seen: Measured) -> None:
        """Take view views[k] as a measurement of track tracks[k]."""
        pose = self._to_sensor[seen.sensor]
        R = pose.rotation
        for track, view in zip(tracks.tolist(), views.tolist(), strict=True):
            one = self._filters[track]
            noise = self._pose_noise(one.x, seen.sensor) + R @ seen.covariance_m2[view] @ R.T
            one.update(z=pose.apply(seen.position_m[view]) - pose.translation_m, R=noise, H=R)

    def add(self, views: Ints, seen: Measured) -> None:
        """Begin a track at each of the views, as unsure as the view and the sensor's pose."""
        from filterpy.kalman import KalmanFilter

        R = self._to_sensor[seen.sensor].rotation
        for view in views.tolist():
            one = KalmanFilter(dim_x=3, dim_z=3)
            one.x = seen.position_m[view].copy()
            one.P = seen.covariance_m2[view] + R.T @ self._pose_noise(one.x, seen.sensor) @ R
            one.F = np.eye(3)
            self._filters.append(one)

    def keep(self, which: Bools) -> None:
        """Drop the tracks that are not in `which` (n,)."""
        self._filters = [one for one, stays in zip(self._filters, which.tolist(), strict=True) if stays]

    def loosen(self, track: int, speed_m_s: float, displacement_m: float) -> None:
        """Do nothing: in the source's model fruit do not slip."""
