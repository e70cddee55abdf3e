"""The belt's motion: what all fruit on it have in common."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from fruitgui.frame import F64


@dataclass(frozen=True, slots=True, eq=False)
class BeltMotion:
    """The belt's velocity, with how sure it is.

    Attributes:
        velocity_m_s: (3,) in the reference frame.
        covariance: (3, 3) of the velocity, m²/s².
    """

    velocity_m_s: F64
    covariance: F64 = field(default_factory=lambda: np.diag([1e-4, 1e-4, 1e-8]))

    @property
    def speed_m_s(self) -> float:
        """Length of the velocity."""
        return float(np.linalg.norm(self.velocity_m_s))
