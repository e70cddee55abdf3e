"""The belt's velocity from the first seconds, with no prior: direction and speed unknown."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F64, Bools, Ints
from fruitgui.geometry.rig import Rig
from fruitgui.perception.view import Observation
from fruitgui.tracking.belt import BeltMotion
from fruitgui.tracking.field import FieldOfView
from fruitgui.tracking.follow import FASTEST_M_S
from fruitgui.tracking.measured import LOOK_STD, Measured, measured

WINDOW_S = 2.0
LONGEST_LAG_S = 0.9
PLACE_STD_M = 0.008
CELL_M_S = 0.02
THINNEST_S = 0.08
MOST_VIEWS = 420
STANDING_M_S = 0.01
"""A window in which nothing moves faster is used only if no other one shows more: the belt will start."""

CLEARLY = 1.25
"""How much more views the best velocity must explain than any other."""


@dataclass(frozen=True, slots=True, eq=False)
class _Pairs:
    """Pairs of views that could be one fruit, sorted by (earlier view, later frame).

    Attributes:
        lag_s: (k,). moved_m: (k, 2). likeness: (k,).
        group: (k,) number of the (earlier view, later frame).
        early: (k,) the earlier view.
    """

    lag_s: F64
    moved_m: F64
    likeness: F64
    group: Ints
    early: Ints


def estimate_belt(observations: Iterable[Observation], rig: Rig) -> BeltMotion | None:
    """Return the belt's velocity as the fruit of these observations show it; None where they do not decide it.

    Every pair of views that look alike votes for a velocity; the velocity wins that
    carries most views onto views. An empty belt at first does not matter: the first
    window of two seconds that decides is used.
    """
    field = FieldOfView.of(rig)
    seen = [measured(observation, rig, field) for observation in observations]
    return estimate_from([one for one in seen if len(one)], rig)


def estimate_from(seen: Sequence[Measured], rig: Rig, clearly: float = CLEARLY) -> BeltMotion | None:
    """Return the velocity that the first deciding window of these captures (in order of time, none empty) shows.

    `clearly` says how many times as many views it must explain as any other velocity.
    """
    start, standing = 0, None
    while start < len(seen):
        window = [one for one in seen[start:] if one.time_s <= seen[start].time_s + WINDOW_S]
        motion = _estimate_window(window, rig, clearly)
        if motion is not None and motion.speed_m_s > STANDING_M_S:
            return motion
        standing = standing or motion
        start += max(1, len(window) // 2)
    return standing


def _thinned(seen: Sequence[Measured]) -> list[Measured]:
    """Return captures at most every `THINNEST_S` of each sensor, and not too many views in all."""
    last: dict[str, float] = {}
    kept: list[Measured] = []
    for one in seen:
        if one.time_s - last.get(one.sensor, -np.inf) >= THINNEST_S:
            last[one.sensor] = one.time_s
            kept.append(one)
    views = np.cumsum([len(one) for one in kept])
    return [one for one, so_far in zip(kept, views, strict=True) if so_far <= MOST_VIEWS]


def _estimate_window(seen: Sequence[Measured], rig: Rig, clearly: float) -> BeltMotion | None:
    kept = _thinned(seen)
    if len(kept) < 3:
        return None
    frame = rig.belt_frame()
    pairs = _pairs(kept, [frame.apply(one.position_m)[:, :2] for one in kept])
    if len(pairs.lag_s) < 3:
        return None
    candidates = _candidates(pairs)
    scores = np.array([_score(pairs, candidate) for candidate in candidates])
    best = int(np.argmax(scores))
    velocity, matched = _refined(pairs, candidates[best])
    if not _decided(pairs, matched, scores, candidates, velocity, clearly):
        return None
    return _motion(pairs, matched, velocity, frame.rotation)


def _pairs(kept: Sequence[Measured], places: Sequence[F64]) -> _Pairs:
    keep = [~one.cut for one in kept]
    number = np.concatenate([np.full(int(k.sum()), i) for i, k in enumerate(keep)]).astype(np.intp)
    time_s = np.array([one.time_s for one in kept])[number]
    xy = np.concatenate([place[k] for place, k in zip(places, keep, strict=True)])
    looks = np.concatenate([one.looks[k] for one, k in zip(kept, keep, strict=True)]) / (LOOK_STD * np.sqrt(2.0))
    lag = time_s[None] - time_s[:, None]
    early, late = np.nonzero((lag > 0.03) & (lag <= LONGEST_LAG_S))
    lag_s, moved = lag[early, late], xy[late] - xy[early]
    apart = ((looks[early] - looks[late]) ** 2).sum(axis=1)
    reach = np.linalg.norm(moved, axis=1) <= FASTEST_M_S * lag_s + 2.0 * PLACE_STD_M
    ok = reach & (apart < 14.0)
    early, late, lag_s, moved, apart = early[ok], late[ok], lag_s[ok], moved[ok], apart[ok]
    key = early * (len(kept) + 1) + number[late]
    order = np.argsort(key, kind="stable")
    group = np.cumsum(np.diff(key[order], prepend=key[order][:1]) > 0) if len(key) else key
    return _Pairs(lag_s[order], moved[order], np.exp(-0.5 * apart[order]), group, early[order])


def _candidates(pairs: _Pairs, most: int = 40) -> F64:
    """Return velocities (c, 2) at the peaks of the votes of pairs far enough apart in time to tell; 0 among them."""
    import cv2

    lag = pairs.lag_s
    slow = lag >= min(0.25, float(np.quantile(lag, 0.5)))
    velocity = pairs.moved_m[slow] / lag[slow, None]
    half = int(np.ceil(FASTEST_M_S / CELL_M_S)) + 2
    votes = np.zeros((2 * half + 1, 2 * half + 1))
    cell = np.rint(velocity / CELL_M_S).astype(np.intp) + half
    inside = ((cell >= 0) & (cell <= 2 * half)).all(axis=1)
    np.add.at(votes, (cell[inside, 0], cell[inside, 1]), pairs.likeness[slow][inside] * lag[slow][inside])
    smooth = np.asarray(cv2.GaussianBlur(votes, (0, 0), 1.2))
    peaks = (smooth >= np.asarray(cv2.dilate(smooth, np.ones((3, 3))))) & (smooth > 0)
    at = np.argwhere(peaks)
    strongest = at[np.argsort(-smooth[peaks])[:most]]
    return np.vstack([np.zeros((1, 2)), (strongest - half) * CELL_M_S])


def _kernel(pairs: _Pairs, velocity: F64, loose_m_s: float) -> F64:
    apart = pairs.moved_m - pairs.lag_s[:, None] * velocity
    variance = 2.0 * PLACE_STD_M**2 + (loose_m_s * pairs.lag_s) ** 2
    return np.asarray(np.exp(-0.5 * (apart * apart).sum(axis=1) / variance) * pairs.likeness)


def _group_best(pairs: _Pairs, value: F64) -> F64:
    starts = np.flatnonzero(np.diff(pairs.group, prepend=-1))
    return np.asarray(np.maximum.reduceat(value, starts))


def _score(pairs: _Pairs, velocity: F64) -> float:
    """Return how many views find themselves again in later frames if the belt moves like this."""
    found = _group_best(pairs, _kernel(pairs, velocity, CELL_M_S))
    return float(found.sum())


def _refined(pairs: _Pairs, start: F64) -> tuple[F64, Bools]:
    """Return the velocity fitted to the pairs that agree with `start`, and which those are."""
    velocity = start
    weight = _kernel(pairs, velocity, 1.5 * CELL_M_S)
    for loose in (CELL_M_S, 0.3 * CELL_M_S, 0.0):
        best = _group_best(pairs, weight)
        weight = np.where(weight >= best[pairs.group] - 1e-12, weight, 0.0)
        total = float((weight * pairs.lag_s**2).sum())
        if total <= 0.0:
            break
        velocity = (weight[:, None] * pairs.moved_m * pairs.lag_s[:, None]).sum(axis=0) / total
        weight = _kernel(pairs, velocity, loose)
    apart = np.linalg.norm(pairs.moved_m - pairs.lag_s[:, None] * velocity, axis=1)
    return velocity, np.asarray((apart < 4.0 * PLACE_STD_M) & (pairs.likeness > 0.05))


def _decided(pairs: _Pairs, matched: Bools, scores: F64, candidates: F64, velocity: F64, clearly: float) -> bool:
    """Tell whether enough views agree on the velocity, over enough time, and no other one explains as much."""
    if matched.sum() < 4 or float(np.ptp(pairs.lag_s[matched])) <= 0.0:
        return False
    if float(pairs.lag_s[matched].max()) < 0.15 or len(np.unique(pairs.group[matched])) < 4:
        return False
    other = np.linalg.norm(candidates - velocity, axis=1) > 4.0 * CELL_M_S
    rival = float(scores[other].max()) if other.any() else 0.0
    return float(scores.max()) >= clearly * rival


def _motion(pairs: _Pairs, matched: Bools, velocity: F64, rotation: F64) -> BeltMotion:
    lag = pairs.lag_s[matched]
    fruit = max(1.0, len(np.unique(pairs.early[matched])) / 4.0)
    std = np.sqrt(2.0) * PLACE_STD_M / (np.sqrt(np.mean(lag**2)) * np.sqrt(fruit))
    covariance = np.diag([std**2, std**2, 1e-8])
    return BeltMotion(rotation.T @ np.append(velocity, 0.0), rotation.T @ covariance @ rotation)
