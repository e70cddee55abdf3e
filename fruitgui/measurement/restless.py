"""Tells whether a fruit rocked or rolled while it was seen, from whether turning its views would help."""

from __future__ import annotations

import numpy as np

from fruitgui.measurement.evidence import Evidence
from fruitgui.measurement.prior import Prior
from fruitgui.measurement.residuals import residuals
from fruitgui.measurement.state import State

TURN_SIGMA_RAD = 0.14
"""Spread of the turns of a fruit that rocks: 8°."""

TRIAL_SIGMA_RAD = 0.07

RESTLESS_GAIN = 0.8
"""Mean gain of a view by its own turn, in units of the views' own noise, from which a fruit is taken to be restless.

Fruit at rest give 0.02–0.6 (a ball 0.02, a pear 0.6), fruit that rock by 10° and more, and are not balls, 0.9–3.
"""


def is_restless(state: State, evidence: Evidence, prior: Prior) -> bool:
    """Tell whether small turns of the views would explain more than noise (a score test; nothing is changed)."""
    seen = residuals(state, evidence, turning=True)
    local = seen.by_view.transpose(1, 2, 0).astype(np.float64)
    D = np.matmul((local * seen.weight[..., None]).transpose(0, 2, 1), local)
    b = np.matmul(local.transpose(0, 2, 1), (seen.weight * seen.distance)[..., None])
    b[:, :3, 0] += prior.view_information * state.shift_m
    shifts = D[:, :3, :3] + np.diag(prior.view_information)
    carried = np.matmul(D[:, 3:, :3], np.linalg.inv(shifts))
    turns = D[:, 3:, 3:] - np.matmul(carried, D[:, :3, 3:]) + np.eye(3) / TRIAL_SIGMA_RAD**2
    pull = b[:, 3:] - np.matmul(carried, b[:, :3])
    gain = np.sum(pull * np.linalg.solve(turns, pull), axis=(1, 2))
    counted = seen.view_weight
    return bool(counted @ gain > RESTLESS_GAIN * (counted @ seen.chi2))
