"""Self-calibration of a rig from a still scene: no target, no guess (the source's sections 2.3 and 2.6.2)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations

import numpy as np

from fruitgui.calibration import graph
from fruitgui.calibration.evidence import evidence
from fruitgui.calibration.flat import Shift
from fruitgui.calibration.graph import Edge, Solution
from fruitgui.calibration.pair import Registration, register
from fruitgui.calibration.paper import paper_poses
from fruitgui.calibration.quality import belt_warnings, placed_quality, surface_quality
from fruitgui.calibration.ready import Ready
from fruitgui.calibration.relief import Relief, relief
from fruitgui.calibration.result import Calibration, Code, Reason, Refusal, reason
from fruitgui.calibration.still import Still, average
from fruitgui.calibration.surface import Belt, fit_belt
from fruitgui.errors import InputError
from fruitgui.frame import F64, Frame
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rig import Mount, Rig
from fruitgui.progress import Cancelled, Progress, never_cancelled, no_progress, stop_if

LEAST_MOVED_PX = 60
ENOUGH_LINKS = 2
"""With so many pairs found without a guess, one wrong among them shows as a contradiction; one that the belt's texture
bears out is as good."""

WORST_POSITION_STD_M = 0.0012
WORST_ANGLE_STD_RAD = float(np.radians(0.075))


def calibrate(
    stills: Mapping[str, Sequence[Frame]],
    reference: str | None = None,
    progress: Progress = no_progress,
    cancelled: Cancelled = never_cancelled,
    *,
    with_paper: bool = False,
) -> Calibration | Refusal:
    """Find every sensor's belt and its pose in the reference sensor's frame, or refuse with reasons.

    `stills` holds one or more captures of the still scene by sensor; the reference is the first unless named.
    One sensor alone is a rig too. With `with_paper`, poses by the source's own method come along for comparison.

    Raises:
        InputError: no sensors, no frames of one, or an unknown reference.
        CancelledByUserError: `cancelled` said so.
    """
    sensors = list(stills)
    reference = _checked(sensors, reference)
    averaged: dict[str, Still] = {}
    belts: dict[str, Belt] = {}
    for i, sensor in enumerate(sensors):
        stop_if(cancelled)
        progress(0.4 * i / len(sensors), f"Finding the belt of {sensor}")
        averaged[sensor] = average(stills[sensor])
        belt = fit_belt(averaged[sensor])
        if belt is not None:
            belts[sensor] = belt
    reasons = _beltless(sensors, belts) + _moved(averaged, belts)
    if reasons:
        return _refusal(reasons, averaged, belts, [])
    ready = {sensor: Ready(relief(averaged[sensor], belts[sensor])) for sensor in sensors}
    tried = _registered(ready, progress, cancelled)
    edges = [edge for pair in tried if (edge := _edge(pair)) is not None]
    linked = graph.groups(sensors, edges)
    if len(linked) > 1:
        return _refusal(_unlinked(linked, tried), averaged, belts, tried)
    solution = graph.solve(reference, edges)
    reasons = _contradictions(solution, ready)
    if reasons:
        return _refusal(reasons, averaged, belts, tried)
    progress(0.95, "Placing the sensors")
    placed = _accepted(reference, ready, solution, tried, with_paper=with_paper)
    reasons = _loose(placed)
    return _refusal(reasons, averaged, belts, tried) if reasons else placed


def _checked(sensors: list[str], reference: str | None) -> str:
    if not sensors:
        raise InputError("no_frames", "There are no frames to calibrate from.", "Record a few seconds first.")
    if reference is not None and reference not in sensors:
        raise InputError(
            "unknown_sensor",
            f"There is no sensor {reference}; the recording holds {', '.join(sensors)}.",
            "Name one of these as the reference.",
            values={"sensor": reference},
        )
    return sensors[0] if reference is None else reference


def _beltless(sensors: list[str], belts: Mapping[str, Belt]) -> list[Reason]:
    return [
        reason("too_little_structure", (sensor,), f"{sensor} sees no flat surface that could be the belt.")
        for sensor in sensors
        if sensor not in belts
    ]


def _moved(averaged: Mapping[str, Still], belts: Mapping[str, Belt]) -> list[Reason]:
    """Return which sensors saw the scene move between their own captures, on or just above the belt."""
    reasons = []
    for sensor, belt in belts.items():
        still = averaged[sensor]
        if not still.moved.any():
            continue
        height_m = belt.plane.height_m(still.points())
        moved = still.moved & (np.abs(height_m) < 0.4)
        if moved.sum() > LEAST_MOVED_PX * (still.intrinsics.width / 640) ** 2:
            reasons.append(reason("scene_moved", (sensor,), f"Something moved while {sensor} captured the scene."))
    return reasons


def _registered(ready: Mapping[str, Ready], progress: Progress, cancelled: Cancelled) -> list[Registration]:
    """Register pairs, with no guess until every sensor has enough of them, then from where the others place it.

    Two sensors that each hang on two pairs borne out by texture have nothing to gain from a third; whether they
    agree is judged with the rig as a whole.
    """
    pairs = list(combinations(ready, 2))
    tried: list[Registration] = []
    edges: list[Edge] = []
    for i, (target, source) in enumerate(pairs):
        stop_if(cancelled)
        if min(_links(edges, target), _links(edges, source)) >= 2 * ENOUGH_LINKS and source in _together(edges, target):
            continue
        progress(0.4 + 0.5 * i / len(pairs), f"Matching {source} to {target}")
        tried.append(register(ready[source], ready[target], _expected(edges, target, source)))
        edge = _edge(tried[-1])
        edges += [] if edge is None else [edge]
    return tried


def _expected(edges: Sequence[Edge], target: str, source: str) -> Shift | None:
    """Return the shift that pairs found so far tell of two sensors, once both hang on enough of those."""
    if min(_links(edges, target), _links(edges, source)) < ENOUGH_LINKS:
        return None
    together = _together(edges, target)
    if source not in together:
        return None
    near = [edge for edge in edges if edge.source in together]
    solution = graph.solve(target, near)
    return solution.places[source] if solution.contradiction <= graph.LOOP_BOUND else None


def _links(edges: Sequence[Edge], sensor: str) -> int:
    return sum(ENOUGH_LINKS if edge.textured else 1 for edge in edges if sensor in (edge.source, edge.target))


def _together(edges: Sequence[Edge], sensor: str) -> tuple[str, ...]:
    everyone = sorted({s for edge in edges for s in (edge.source, edge.target)})
    return next(group for group in graph.groups(everyone, edges) if sensor in group)


def _edge(pair: Registration) -> Edge | None:
    if pair.best is None or pair.covariance is None:
        return None
    weight = pair.best.evidence.log_likelihood
    return Edge(pair.source, pair.target, pair.best.shift, pair.covariance, weight, pair.best.textured)


def _unlinked(linked: list[tuple[str, ...]], tried: Sequence[Registration]) -> list[Reason]:
    """Return why the groups could not be linked: what a pair between them says, or that none sees enough in common."""
    group_of = {sensor: k for k, group in enumerate(linked) for sensor in group}
    between = [pair for pair in tried if group_of[pair.source] != group_of[pair.target]]
    telling: tuple[Code, ...] = ("scene_moved", "ambiguous", "too_little_structure")
    reasons = [
        reason(code, (pair.target, pair.source), pair.what) for code in telling for pair in between if pair.code == code
    ]
    apart = [pair for pair in between if pair.code == "too_little_overlap"]
    if not apart:
        return reasons
    names = "; ".join(", ".join(group) for group in linked)
    everyone = tuple(sensor for group in linked for sensor in group)
    split = reason("disconnected", everyone, f"No pair of sensors links these groups: {names}.")
    overlaps = [reason("too_little_overlap", (pair.target, pair.source), pair.what) for pair in apart]
    return [*reasons, *(overlaps if len(everyone) == 2 else []), split]


def _contradictions(solution: Solution, ready: Mapping[str, Ready]) -> list[Reason]:
    """Return where the poses found contradict each other, or what any two sensors see."""
    if solution.contradiction > graph.LOOP_BOUND:
        sensors = tuple(solution.places)
        return [reason("ambiguous", sensors, "The registrations of the pairs contradict each other around a loop.")]
    reasons = []
    for target, source in combinations(solution.places, 2):
        shift = solution.places[target].inverse().after(solution.places[source])
        said = evidence(ready[source].sight, ready[target].sight, shift)
        if said.conflicting and said.agreeing >= 1.5 * said.conflicting:
            what = f"{said.conflicting} things stand where only one of {source} and {target} sees them."
            reasons.append(reason("scene_moved", (target, source), what))
        elif said.conflicting:
            what = f"What {source} and {target} see contradicts the poses found through other sensors."
            reasons.append(reason("ambiguous", (target, source), what))
    return reasons


def _loose(placed: Calibration) -> list[Reason]:
    """Return which sensors what is in common holds too loosely to be trusted within 2 mm and 0.1°."""
    return [
        reason(
            "too_little_structure",
            (sensor,),
            f"What {sensor} has in common with the others holds it only to {1e3 * one.position_std_m:.1f} mm and "
            f"{np.degrees(one.angle_std_rad):.2f}°.",
        )
        for sensor, one in placed.sensors.items()
        if one.position_std_m > WORST_POSITION_STD_M or one.angle_std_rad > WORST_ANGLE_STD_RAD
    ]


def _refusal(
    reasons: list[Reason],
    averaged: Mapping[str, Still],
    belts: Mapping[str, Belt],
    tried: Sequence[Registration],
) -> Refusal:
    return Refusal(
        reasons=tuple(reasons),
        sensors={s: surface_quality(averaged[s], belt, "unlinked") for s, belt in belts.items()},
        pairs=tuple(pair.quality for pair in tried),
        warnings=tuple(text for belt in belts.values() for text in belt.warnings),
        surfaces={s: belt.surface for s, belt in belts.items()},
    )


def _accepted(
    reference: str, ready: Mapping[str, Ready], solution: Solution, tried: Sequence[Registration], *, with_paper: bool
) -> Calibration:
    reliefs = {sensor: one.relief for sensor, one in ready.items()}
    mounts = {}
    for sensor, one in reliefs.items():
        pose = _pose(reliefs[reference], one, solution.places[sensor], solution.covariances[sensor])
        mounts[sensor] = Mount(sensor, pose, one.belt.surface, one.still.intrinsics)
    rig = Rig(reference, mounts)
    used = {(edge.source, edge.target) for edge in solution.used}
    quality = {sensor: placed_quality(sensor, rig, reliefs) for sensor in reliefs}
    dropped = tuple(
        f"The registration of {edge.source} to {edge.target} contradicts the others and was left out."
        for edge in solution.dropped
    )
    return Calibration(
        rig=rig,
        sensors=quality,
        pairs=tuple(pair.quality for pair in tried),
        warnings=(*belt_warnings(reliefs, [p for p in tried if (p.source, p.target) in used], quality), *dropped),
        paper=paper_poses(reference, reliefs, solution, tried) if with_paper else {},
    )


def _pose(reference: Relief, relief: Relief, place: Shift, spread: F64) -> Pose:
    """Return the pose of a sensor in the reference's optical frame: off its belt, across, onto the reference.

    Errors of the two belt planes and of the shift are independent; each acts in its own belt frame.
    """
    if relief is reference:
        return Pose.exact()
    own = Pose(relief.frame.rotation, relief.frame.translation_m, _on_group(relief.belt.covariance, tilt=True))
    across = Pose(place.pose().rotation, place.pose().translation_m, _on_group(spread, tilt=False))
    back = reference.frame.inverse()
    onto = Pose(back.rotation, back.translation_m, np.zeros((6, 6)))
    adrift = Pose(np.eye(3), np.zeros(3), _on_group(reference.belt.covariance, tilt=True))
    return onto @ adrift @ across @ own


def _on_group(spread: F64, *, tilt: bool) -> F64:
    """Return the 6×6 of (ω, v) from (ωx, ωy, z) of a plane, or from (x, y, ωz) of a shift about the origin."""
    places = [0, 1, 5] if tilt else [3, 4, 2]
    covariance = np.zeros((6, 6))
    covariance[np.ix_(places, places)] = spread
    return covariance
