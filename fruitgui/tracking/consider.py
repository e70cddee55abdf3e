"""The product's filter: all fruit at once, with the sensors' pose errors considered but never re-estimated.

A Schmidt-Kalman filter (Schmidt 1966; Simon 2006, "Optimal state estimation",
10.3). A track's state is its position and its slip against the belt. What a
sensor gives is  y = p + J(y) e + b + v:  its pose error e (6, constant while the
rig stands, the same for all fruit), the part b of the centre's error that stays
while this sensor looks at this fruit (3), and the noise v of one capture. e and
b keep their prior variance; their covariance with each track is carried, so
that a hundred captures by one sensor never look surer than its pose.
"""

from __future__ import annotations

import numpy as np

from fruitgui.frame import F64, Bools, Ints
from fruitgui.geometry.rig import Rig
from fruitgui.tracking.measured import Measured
from fruitgui.tracking.settings import TrackerSettings

UNKNOWN_POSE = np.diag([0.002**2] * 3 + [0.003**2] * 3)
"""Assumed covariance of a pose that carries none: 2 mrad and 3 mm, what a station may be off by and still work."""

_EYE = np.eye(3)


class ConsiderFilter:
    """Positions of n fruit with honest covariances.

    Attributes:
        position_m: (n, 3) reference frame.
        covariance: (n, 6, 6) of (position, slip velocity).
        slip_m_s: (n, 3) velocity against the belt.
    """

    def __init__(self, rig: Rig, settings: TrackerSettings) -> None:
        self._settings = settings
        self._index = {sensor: i for i, sensor in enumerate(rig.mounts)}
        self._pose = np.stack([pose_covariance(rig, sensor) for sensor in rig.mounts])
        sensors = len(self._index)
        self.position_m: F64 = np.zeros((0, 3))
        self.slip_m_s: F64 = np.zeros((0, 3))
        self.covariance: F64 = np.zeros((0, 6, 6))
        self._cross: F64 = np.zeros((0, sensors, 6, 9))
        self._lasting: F64 = np.zeros((0, sensors, 3, 3))

    def __len__(self) -> int:
        return len(self.position_m)

    @property
    def position_covariance_m2(self) -> F64:
        """The (n, 3, 3) blocks of the positions."""
        return self.covariance[:, :3, :3]

    def predict(self, duration_s: float, displacement_m: F64) -> None:
        """Carry all fruit along with the belt for a while; a late capture may ask for a negative duration."""
        tau, length = self._settings.slip_time_s, abs(duration_s)
        fade = float(np.exp(-length / tau))
        reach = float(np.sign(duration_s)) * tau * (1.0 - fade)
        self.position_m = self.position_m + displacement_m + reach * self.slip_m_s
        self.slip_m_s = fade * self.slip_m_s
        F = np.eye(6)
        F[:3, 3:] = reach * _EYE
        F[3:, 3:] = fade * _EYE
        self.covariance = F @ self.covariance @ F.T + self._slip_noise(length)
        self._cross = F @ self._cross

    def _slip_noise(self, length_s: float) -> F64:
        """Return the (6, 6) noise of a slip that fades (Ornstein-Uhlenbeck), integrated over `length_s`."""
        tau, variance = self._settings.slip_time_s, self._settings.slip_speed_m_s**2
        a = np.exp(-length_s / tau)
        Q = np.zeros((6, 6))
        Q[:3, :3] = variance * tau * (2.0 * length_s - tau * (3.0 - 4.0 * a + a * a)) * _EYE
        Q[:3, 3:] = Q[3:, :3] = variance * tau * (1.0 - a) ** 2 * _EYE
        Q[3:, 3:] = variance * (1.0 - a * a) * _EYE
        return Q

    def shift(self, displacement_m: F64) -> None:
        """Move all fruit by what their common motion was mispredicted by, (3,)."""
        self.position_m = self.position_m + displacement_m

    def innovations(self, tracks: Ints, views: Ints, seen: Measured) -> tuple[F64, F64]:
        """Return residuals (k, 3) of views[i] to tracks[i], and their covariances (k, 3, 3)."""
        s = self._index[seen.sensor]
        G = pose_jacobians(seen.position_m)
        pose = G[:, :, :6] @ self._pose[s] @ G[:, :, :6].transpose(0, 2, 1)
        mixed = self._cross[tracks, s, :3] @ G[views].transpose(0, 2, 1)
        S = self.position_covariance_m2[tracks] + (seen.covariance_m2 + pose)[views]
        return seen.position_m[views] - self.position_m[tracks], S + mixed + mixed.transpose(0, 2, 1)

    def update(self, tracks: Ints, views: Ints, seen: Measured) -> None:
        """Take view views[k] as a measurement of track tracks[k]; no track twice."""
        if not len(tracks):
            return
        s = self._index[seen.sensor]
        self._begin_lasting(tracks, s, seen.covariance_m2[views])
        y = seen.position_m[views]
        R = np.maximum(1.0 - self._settings.lasting_share, 0.0) * seen.covariance_m2[views]
        G, considered = pose_jacobians(y), self._considered(tracks, s)
        P, C = self.covariance[tracks], self._cross[tracks]
        GT = G.transpose(0, 2, 1)
        own = C[:, s] @ GT
        PHt = P[:, :, :3] + own
        S = PHt[:, :3] + own[:, :3].transpose(0, 2, 1) + G @ considered @ GT + R
        K = np.linalg.solve(S, PHt.transpose(0, 2, 1)).transpose(0, 2, 1)
        change = (K @ (y - self.position_m[tracks])[:, :, None])[:, :, 0]
        HC = C[:, :, :3].copy()
        HC[:, s] += G @ considered
        P = P - K @ S @ K.transpose(0, 2, 1)
        self.position_m[tracks] += change[:, :3]
        self.slip_m_s[tracks] += change[:, 3:]
        self.covariance[tracks] = 0.5 * (P + P.transpose(0, 2, 1))
        self._cross[tracks] = C - K[:, None] @ HC

    def _begin_lasting(self, tracks: Ints, s: int, covariance_m2: F64) -> None:
        fresh = ~self._lasting[tracks, s].any(axis=(1, 2))
        self._lasting[tracks[fresh], s] = self._settings.lasting_share * covariance_m2[fresh]

    def _considered(self, tracks: Ints, s: int) -> F64:
        considered = np.zeros((len(tracks), 9, 9))
        considered[:, :6, :6] = self._pose[s]
        considered[:, 6:, 6:] = self._lasting[tracks, s]
        return considered

    def add(self, views: Ints, seen: Measured) -> None:
        """Begin a track at each of the views."""
        n, s = len(views), self._index[seen.sensor]
        share = self._settings.lasting_share
        y, R = seen.position_m[views], seen.covariance_m2[views]
        lasting = np.zeros((n, *self._lasting.shape[1:]))
        lasting[:, s] = share * R
        considered = np.zeros((n, 9, 9))
        considered[:, :6, :6] = self._pose[s]
        considered[:, 6:, 6:] = lasting[:, s]
        G = pose_jacobians(y)
        P = np.zeros((n, 6, 6))
        P[:, :3, :3] = G @ considered @ G.transpose(0, 2, 1) + (1.0 - share) * R
        P[:, 3:, 3:] = self._settings.slip_speed_m_s**2 * _EYE
        cross = np.zeros((n, *self._cross.shape[1:]))
        cross[:, s, :3] = -G @ considered
        self.position_m = np.vstack([self.position_m, y])
        self.slip_m_s = np.vstack([self.slip_m_s, np.zeros((n, 3))])
        self.covariance = np.concatenate([self.covariance, P])
        self._cross = np.concatenate([self._cross, cross])
        self._lasting = np.concatenate([self._lasting, lasting])

    def keep(self, which: Bools) -> None:
        """Drop the tracks that are not in `which` (n,)."""
        self.position_m, self.slip_m_s = self.position_m[which], self.slip_m_s[which]
        self.covariance, self._cross, self._lasting = self.covariance[which], self._cross[which], self._lasting[which]

    def loosen(self, track: int, speed_m_s: float, displacement_m: float) -> None:
        """Let one fruit go its own way: it rolled or was pushed."""
        self.covariance[track, :3, :3] += displacement_m**2 * _EYE
        self.covariance[track, 3:, 3:] += speed_m_s**2 * _EYE


def pose_covariance(rig: Rig, sensor: str) -> F64:
    """Return the (6, 6) covariance of a sensor's pose; zero for the reference, a guess where none is known."""
    covariance = rig.mounts[sensor].pose.covariance
    if covariance is not None:
        return np.asarray(covariance, dtype=np.float64)
    return np.zeros((6, 6)) if sensor == rig.reference else UNKNOWN_POSE


def pose_jacobians(points_m: F64) -> F64:
    """Return d(true point)/d(ω, v, b) at mapped points (m, 3): (m, 3, 9), where b adds to the point."""
    G = np.zeros((len(points_m), 3, 9))
    x, y, z = points_m.T
    G[:, 0, 1], G[:, 0, 2] = z, -y
    G[:, 1, 0], G[:, 1, 2] = -z, x
    G[:, 2, 0], G[:, 2, 1] = y, -x
    G[:, :, 3:6] = _EYE
    G[:, :, 6:] = _EYE
    return G
