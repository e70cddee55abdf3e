"""The robot-arm experiment (the source's section 2.8): how wrong registration is, against views from known poses."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from fruitgui.calibration.arbitrary import Link, Match, Scan, both_ways, grain_m, scan
from fruitgui.calibration.network import Hands, OneHand, register_all
from fruitgui.calibration.still import Still, average
from fruitgui.frame import F64, Frame
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rotation import vector_from_rotation
from fruitgui.progress import Cancelled, Progress, never_cancelled, no_progress, stop_if


@dataclass(frozen=True, slots=True)
class Component:
    """A Gaussian fitted to one component of the error.

    Attributes:
        mean, std: of the component; R has no unit, T is in metres.
        normal_p: probability that a Gaussian looks at least this unlike one (Shapiro–Wilk); 1 for fewer than 8 pairs.
    """

    mean: float
    std: float
    normal_p: float


@dataclass(frozen=True, slots=True, eq=False)
class Errors:
    """Errors of one method over all registered pairs.

    Attributes:
        rotation_rad, translation_m: (N,) angle of R_ICP R_realᵀ and length of T_ICP − T_real.
        E_R, E_T: (N, 3, 3) and (N, 3), R_ICP − R_real and T_ICP − T_real.
        R: 3×3 components of E_R. T_m: 3 components of E_T.
        se3_covariance: (6, 6) of (ω, v), where the real pose is exp([ω]×)(R_ICP X + T_ICP) + v, about zero.
    """

    rotation_rad: F64
    translation_m: F64
    E_R: F64
    E_T: F64
    R: tuple[tuple[Component, ...], ...]
    T_m: tuple[Component, ...]
    se3_covariance: F64


@dataclass(frozen=True, slots=True, eq=False)
class Closure:
    """How well registrations agree among themselves: a → b → c against a → c, which needs no known pose.

    Attributes:
        rotation_rad, translation_m: (N,) of every triple of views whose three pairs were registered.
    """

    rotation_rad: F64
    translation_m: F64


@dataclass(frozen=True, slots=True)
class LeftOut:
    """A pair of views that was not registered, and why."""

    source: int
    target: int
    reason: str


@dataclass(frozen=True, slots=True, eq=False)
class Study:
    """The whole experiment.

    Attributes:
        views: how many. pairs: ordered pairs of them. registered: pairs accepted.
        product, paper: errors of both methods over the same pairs; None where no pair was registered.
        closure: how well the product's registrations agree among themselves; errors far above it are not theirs
            but of the known poses, or of what bends the sensor's depth.
        left_out: the other pairs.
    """

    views: int
    pairs: int
    registered: int
    product: Errors | None
    paper: Errors | None
    closure: Closure | None
    left_out: tuple[LeftOut, ...]


def study(
    views: Sequence[tuple[Frame, Pose]],
    progress: Progress = no_progress,
    cancelled: Cancelled = never_cancelled,
    hands: Hands | None = None,
) -> Study:
    """Register all ordered pairs of views and compare with their known poses (sensor → fixed frame).

    The known poses take no part in registering. What is the same in both directions of a pair is done once.

    Raises:
        CancelledByUserError: `cancelled` said so.
    """
    hands = hands or OneHand()
    scans = _scans([frame for frame, _ in views], hands, _part(progress, 0.0, 0.05), cancelled)
    links = register_all(scans, hands, _part(progress, 0.05, 0.9), cancelled)
    matches: dict[tuple[int, int], Match] = {}
    tasks = [(scans[a], scans[b], link) for (a, b), link in links.items()]
    for number, (there, back) in hands.each(_both_ways, tasks):
        a, b = list(links)[number]
        matches[a, b], matches[b, a] = there, back
        stop_if(cancelled)
        progress(0.9 + 0.1 * len(matches) / (2 * len(links)), "Registering the source's way")
    return summed_up([pose for _, pose in views], dict(sorted(matches.items())))


def _part(progress: Progress, start: float, end: float) -> Progress:
    return lambda done, doing: progress(start + (end - start) * done, doing)


def _scans(frames: Sequence[Frame], hands: Hands, progress: Progress, cancelled: Cancelled) -> list[Scan]:
    stills = [average([frame]) for frame in frames]
    grain = grain_m(stills)
    scans: dict[int, Scan] = {}
    for number, made in hands.each(_scan, [(still, grain) for still in stills]):
        scans[number] = made
        stop_if(cancelled)
        progress(len(scans) / len(stills), f"Preparing views: {len(scans)} of {len(stills)}")
    return [scans[number] for number in range(len(stills))]


def _scan(task: tuple[Still, float]) -> Scan:
    return scan(*task)


def _both_ways(task: tuple[Scan, Scan, Link]) -> tuple[Match, Match]:
    return both_ways(*task)


def summed_up(poses: Sequence[Pose], matches: Mapping[tuple[int, int], Match]) -> Study:
    """Compare registrations with the truth."""
    accepted = {pair: match for pair, match in matches.items() if match.pose is not None}
    real = [real_pose(poses[source], poses[target]) for source, target in accepted]
    product = [match.pose for match in accepted.values() if match.pose is not None]
    paper = [match.paper for match in accepted.values() if match.paper is not None]
    return Study(
        views=len(poses),
        pairs=len(matches),
        registered=len(accepted),
        product=errors(product, real) if product else None,
        paper=errors(paper, real) if paper else None,
        closure=closure({pair: match.pose for pair, match in accepted.items() if match.pose is not None}, len(poses)),
        left_out=tuple(LeftOut(*pair, match.reason) for pair, match in matches.items() if match.pose is None),
    )


def closure(found: Mapping[tuple[int, int], Pose], views: int) -> Closure | None:
    """Return how far every triple of pairs fails to close; None where there is none."""
    triples = [
        (found[a, b], found[b, c], found[a, c])
        for a, b, c in combinations(range(views), 3)
        if {(a, b), (b, c), (a, c)} <= found.keys()
    ]
    if not triples:
        return None
    gaps = [(last @ first) @ direct.inverse() for first, last, direct in triples]
    return Closure(
        rotation_rad=np.array([float(np.linalg.norm(vector_from_rotation(gap.rotation))) for gap in gaps]),
        translation_m=np.array(
            [np.linalg.norm((b @ a).translation_m - direct.translation_m) for a, b, direct in triples], np.float64
        ),
    )


def real_pose(source: Pose, target: Pose) -> Pose:
    """Return R_real = R₁R₂⁻¹, T_real = T₁ − R₁R₂⁻¹T₂ of views given as sensor → fixed.

    R_k, T_k map the fixed frame to view k: the inverse of a row of the poses file. View 1 is the target
    into which view 2, the source, is registered.
    """
    first, second = target.inverse(), source.inverse()
    rotation = first.rotation @ second.rotation.T
    return Pose(rotation, first.translation_m - rotation @ second.translation_m)


def errors(found: Sequence[Pose], real: Sequence[Pose]) -> Errors:
    """Return E_R and E_T of every pair, a Gaussian for each component, and the covariance on SE(3)."""
    E_R = np.array([one.rotation - truth.rotation for one, truth in zip(found, real, strict=True)])
    E_T = np.array([one.translation_m - truth.translation_m for one, truth in zip(found, real, strict=True)])
    twists = np.array([_twist(one, truth) for one, truth in zip(found, real, strict=True)])
    return Errors(
        rotation_rad=np.linalg.norm(twists[:, :3], axis=1),
        translation_m=np.linalg.norm(E_T, axis=1),
        E_R=E_R,
        E_T=E_T,
        R=tuple(tuple(gaussian(E_R[:, i, j]) for j in range(3)) for i in range(3)),
        T_m=tuple(gaussian(E_T[:, i]) for i in range(3)),
        se3_covariance=twists.T @ twists / len(twists),
    )


def _twist(found: Pose, real: Pose) -> F64:
    """Return (ω, v) with real = exp([ω]×)(R X + T) + v."""
    rotation = real.rotation @ found.rotation.T
    return np.concatenate([vector_from_rotation(rotation), real.translation_m - rotation @ found.translation_m])


def gaussian(values: F64) -> Component:
    """Fit a Gaussian and test whether it is one."""
    from scipy.stats import shapiro

    if len(values) < 8 or np.ptp(values) < 1e-12:
        return Component(float(np.mean(values)), float(np.std(values)), 1.0)
    return Component(float(np.mean(values)), float(np.std(values, ddof=1)), float(shapiro(values[:5000]).pvalue))
