"""Register two views of any scene, with no belt and no guess: the error study's own registration.

A pair of views is registered once for both directions. What is found is judged by what each view sees where the
other's surfaces would stand, and by how firmly these hold it; what is contradicted, meets over too little or could
slide is left out with a reason.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from fruitgui.calibration.guesses import Shape, differ, guesses, shape
from fruitgui.calibration.paper import point_to_point
from fruitgui.calibration.patches import Patches, patches
from fruitgui.calibration.sliding import LEAST_SPREAD, NEARLY, ROUGHLY, Slid, Stage, pixels, slide
from fruitgui.calibration.still import SAME_READING, Still
from fruitgui.frame import F32, F64, Bools
from fruitgui.geometry.pose import Pose

GRAIN_SHARE = 0.025
"""Shape is described in grains of this share of how far the views look."""

LEAST_OVERLAP = 0.35
"""Of the view of which more meets: the other may look from farther off and see much besides."""

LEAST_OF_OTHER = 0.12
MOST_THROUGH = 0.02
WORST_STD_M = 0.0025
"""How loosely surfaces may hold a pose, where residuals spread as a sound Kinect's do. It is shape that is asked for:
with a device that bends depth everything is held in proportion more loosely, which is its own fault."""

HOPELESS_THROUGH = 0.30
PAPER_REACH_M = 0.05
TOLD_BY = 3
"""A view's patches are thinned by this where a rough answer will do."""


@dataclass(frozen=True, slots=True, eq=False)
class Scan:
    """One view made ready: all work that its pairs share.

    Attributes:
        patches: of its surface.
        shape: what its places look like.
        nearest, farthest: (H, W) largest and smallest inverse depth within two pixels, 1/m.
        sure: (H, W) most pixels around have a reading.
    """

    patches: Patches
    shape: Shape
    nearest: F32
    farthest: F32
    sure: Bools


@dataclass(frozen=True, slots=True, eq=False)
class Match:
    """A registration of two views, one direction of it.

    Attributes:
        pose: source's optical frame → target's; None where it is left out.
        paper: what plain point-to-point ICP makes of the same first guess; None where left out.
        reason: why it is left out, or empty.
        overlap: share of the source that meets the target.
    """

    pose: Pose | None
    paper: Pose | None
    reason: str
    overlap: float


@dataclass(frozen=True, slots=True, eq=False)
class Link:
    """A registration of two views, both directions at once.

    Attributes:
        pose: the first view's optical frame → the second's, with its covariance; the best there is, though doubted.
        start: the first guess it came from. Both None where nothing was found.
        overlap: share of the first view that meets the second, and the reverse.
        through: share of the first that the second looks through, and the reverse.
        doubt: why it is not to be trusted, or empty.
    """

    pose: Pose | None
    start: Pose | None
    overlap: tuple[float, float]
    through: tuple[float, float]
    doubt: str

    @property
    def score(self) -> float:
        """The more the better: links of one pair may be compared."""
        return max(self.overlap) + min(self.overlap) - 8.0 * max(self.through)


NOTHING = Link(None, None, (0.0, 0.0), (1.0, 1.0), "too little overlap: no places look alike")


def grain_m(stills: Sequence[Still]) -> float:
    """Return the grain at which all these views are described: it goes with how far they look."""
    depths = [float(np.median(still.inverse_depth[still.seen])) for still in stills if still.seen.any()]
    return GRAIN_SHARE / float(np.median(depths)) if depths else GRAIN_SHARE


def scan(still: Still, grain_m: float) -> Scan:
    """Prepare one view."""
    fitted = patches(still)
    reach = 2 * max(1, round(2 * still.intrinsics.width / 640)) + 1
    kernel = np.ones((reach, reach), np.uint8)
    q = still.inverse_depth
    return Scan(
        patches=fitted,
        shape=shape(fitted, grain_m),
        nearest=np.asarray(cv2.dilate(q, kernel), dtype=np.float32),
        farthest=np.asarray(-cv2.dilate(np.where(q > 0, -q, -np.inf).astype(np.float32), kernel), dtype=np.float32),
        sure=np.asarray(cv2.boxFilter((q > 0).astype(np.float32), -1, (reach, reach)) > 0.7),
    )


def search(first: Scan, second: Scan) -> Link:
    """Register two views from nothing but themselves."""
    links = []
    for start in guesses(first.shape, second.shape):
        if max(judged(first, second, start, TOLD_BY)[1]) < HOPELESS_THROUGH:
            rough = slide(first.patches, second.patches, start, ROUGHLY, TOLD_BY)
            if rough is not None:
                links.append(settled(first, second, rough.pose, start))
    if not links:
        return NOTHING
    links.sort(key=lambda link: -link.score)
    best = links[0]
    rivals = [link for link in links[1:] if _rival(best, link)]
    if rivals and not best.doubt:
        return Link(best.pose, best.start, best.overlap, best.through, "ambiguous: two different poses fit as well")
    return best


def _rival(best: Link, other: Link) -> bool:
    if best.pose is None or other.pose is None or max(other.through) > 2 * MOST_THROUGH:
        return False
    return differ(best.pose, other.pose, 0.02, np.radians(1.5)) and other.score > 0.85 * best.score


def settled(first: Scan, second: Scan, near: Pose, start: Pose, schedule: tuple[Stage, ...] = NEARLY) -> Link:
    """Slide two views that lie nearly on each other to rest, and judge the result."""
    slid = slide(first.patches, second.patches, near, schedule)
    if slid is None:
        return NOTHING
    overlap, through = judged(first, second, slid.pose)
    return Link(slid.pose, start, overlap, through, _doubt(overlap, through, slid))


def _doubt(overlap: tuple[float, float], through: tuple[float, float], slid: Slid) -> str:
    if max(overlap) < LEAST_OVERLAP or min(overlap) < LEAST_OF_OTHER:
        return f"too little overlap: {max(overlap):.0%} of one view meets the other, {min(overlap):.0%} of the other"
    if max(through) > MOST_THROUGH:
        return f"contradicted: one view looks through {max(through):.1%} of the other"
    loose = held_to_m(slid.pose)
    if loose > WORST_STD_M * slid.spread / LEAST_SPREAD:
        return f"too little structure: surfaces hold it to {1e3 * loose:.1f} mm only"
    return ""


def held_to_m(pose: Pose) -> float:
    """Return the largest standard deviation of where a pose puts what lies a metre before the target's sensor."""
    if pose.covariance is None:
        return np.inf
    J = pose.point_jacobian(np.array([0.0, 0.0, 1.0]))
    return float(np.sqrt(np.linalg.eigvalsh(J @ pose.covariance @ J.T)[-1]))


def judged(first: Scan, second: Scan, pose: Pose, thinned: int = 1) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return what share of each view meets the other, and what share of it the other looks through."""
    one = _testified(first.patches.points_m[::thinned], second, pose)
    other = _testified(second.patches.points_m[::thinned], first, pose.inverse())
    return (one[0], other[0]), (one[1], other[1])


def _testified(points_m: F64, witness: Scan, pose: Pose) -> tuple[float, float]:
    local = pose.apply(points_m)
    v, u, inside = pixels(witness.patches.camera, local)
    q = 1.0 / np.where(inside, local[:, 2], 1.0)
    known = inside & witness.sure[v, u]
    through = known & (witness.nearest[v, u] < q - SAME_READING)
    hidden = known & (witness.farthest[v, u] > q + SAME_READING)
    met = int((known & ~through & ~hidden).sum())
    return met / max(len(points_m), 1), float(through.sum()) / max(met + int(through.sum()), 1)


def both_ways(first: Scan, second: Scan, link: Link) -> tuple[Match, Match]:
    """Return a link as its two directions, with the source's own method beside it where it is trusted."""
    if link.doubt or link.pose is None or link.start is None:
        return tuple(Match(None, None, link.doubt, overlap) for overlap in link.overlap)  # type: ignore[return-value]
    a, b = first.patches.points_m, second.patches.points_m
    there = point_to_point(a, b, link.start, PAPER_REACH_M)
    back = point_to_point(b, a, link.start.inverse(), PAPER_REACH_M)
    return Match(link.pose, there, "", link.overlap[0]), Match(link.pose.inverse(), back, "", link.overlap[1])
