"""Register all pairs of many views: what neighbours found leads to pairs that find nothing by themselves.

Every pair is searched alone first. Those that are trusted, and that close in loops with others, make a network; along
it every other pair gets a start, which also tells cheaply whether its views can meet at all. What does not close with
the rest is left out. Known poses take no part.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from heapq import heappop, heappush
from itertools import combinations
from typing import Protocol, TypeVar

import numpy as np

from fruitgui.calibration.arbitrary import (
    LEAST_OF_OTHER,
    LEAST_OVERLAP,
    TOLD_BY,
    Link,
    Scan,
    held_to_m,
    judged,
    search,
    settled,
)
from fruitgui.calibration.guesses import differ
from fruitgui.geometry.pose import Pose
from fruitgui.progress import Cancelled, Progress, stop_if

Pair = tuple[int, int]
Links = Mapping[Pair, Link]
T = TypeVar("T")
R = TypeVar("R")

CLOSES_M, CLOSES_RAD = 0.04, float(np.radians(2.5))
"""Loops of three right ones close within this, a metre before the sensor: real sensors bend depth by centimetres."""

FEWEST_LOOPS, STRAY = 3, 3.0
"""A pair whose loops, at least so many, close so many times worse than usual is at fault and not its partners."""

WORTH_SLIDING = 0.7
"""Share of the least overlap that a start must promise: sliding adds to it."""


class Hands(Protocol):
    """Does one thing with each of many, perhaps several at a time."""

    def each(self, work: Callable[[T], R], on: Sequence[T]) -> Iterator[tuple[int, R]]:
        """Yield the number of each thing and what came of it, in any order."""


class OneHand:
    """Does one after the other."""

    def each(self, work: Callable[[T], R], on: Sequence[T]) -> Iterator[tuple[int, R]]:
        """Yield the number of each thing and what came of it."""
        for number, one in enumerate(on):
            yield number, work(one)


def register_all(scans: Sequence[Scan], hands: Hands, progress: Progress, cancelled: Cancelled) -> dict[Pair, Link]:
    """Return the link of every unordered pair (a < b) of views.

    Raises:
        CancelledByUserError: `cancelled` said so.
    """
    pairs = list(combinations(range(len(scans)), 2))
    links: dict[Pair, Link] = {}
    for number, link in hands.each(_search, [(scans[a], scans[b]) for a, b in pairs]):
        links[pairs[number]] = link
        stop_if(cancelled)
        progress(0.8 * len(links) / len(pairs), f"Comparing views: {len(links)} of {len(pairs)} pairs")
    links = without_contradicted(links)
    led = [(pair, start) for pair, start in starts(links, len(scans)).items() if links[pair].doubt]
    tasks = [(scans[a], scans[b], start) for (a, b), start in led]
    for done, (number, link) in enumerate(hands.each(_follow, tasks)):
        links[led[number][0]] = link
        stop_if(cancelled)
        progress(0.8 + 0.2 * done / len(led), f"Following neighbours: {done + 1} of {len(led)} pairs")
    return without_strays(without_contradicted(links))


def _search(task: tuple[Scan, Scan]) -> Link:
    return search(*task)


def _follow(task: tuple[Scan, Scan, Pose]) -> Link:
    """Slide a pair to rest from where its neighbours put it, if so little as a start promises any overlap."""
    first, second, start = task
    overlap, through = judged(first, second, start, TOLD_BY)
    if max(overlap) < WORTH_SLIDING * LEAST_OVERLAP or min(overlap) < WORTH_SLIDING * LEAST_OF_OTHER:
        doubt = f"too little overlap: by their neighbours {max(overlap):.0%} of one view meets the other at most"
        return Link(start, start, overlap, through, doubt)
    found = settled(first, second, start, start)
    if found.pose is not None and not found.doubt and differ(found.pose, start, CLOSES_M, CLOSES_RAD):
        return replace(found, doubt="contradicted: neighbouring views put it elsewhere")
    return found


def trusted(links: Links) -> dict[Pair, Pose]:
    """Return the poses of links without doubt, both ways."""
    poses: dict[Pair, Pose] = {}
    for (a, b), link in links.items():
        if not link.doubt and link.pose is not None:
            poses[a, b], poses[b, a] = link.pose, link.pose.inverse()
    return poses


def without_contradicted(links: Links) -> dict[Pair, Link]:
    """Doubt links that fail to close in more loops of three than they close in, the worst first."""
    kept = dict(links)
    while True:
        worst = _most_contradicted(kept)
        if worst is None:
            return kept
        kept[worst] = replace(kept[worst], doubt="contradicted: it does not close with what other views found")


def _most_contradicted(links: Links) -> Pair | None:
    poses = trusted(links)
    closed: dict[Pair, int] = {}
    for loop in _loops(poses):
        (a, b), (_, c) = loop[:2]
        closes = not differ(poses[b, c] @ poses[a, b], poses[a, c], CLOSES_M, CLOSES_RAD)
        for pair in loop:
            closed[pair] = closed.get(pair, 0) + (1 if closes else -1)
    # In a lone loop that fails any of the three may be wrong; the one that fits worst goes.
    failing = [(count, links[pair].score, pair) for pair, count in closed.items() if count < 0]
    return min(failing)[2] if failing else None


def without_strays(links: Links) -> dict[Pair, Link]:
    """Doubt links whose loops of three close far worse than loops of these views do: they came to rest beside it."""
    poses = trusted(links)
    gaps: dict[Pair, list[tuple[float, float]]] = {}
    for loop in _loops(poses):
        (a, b), (_, c) = loop[:2]
        gap = (poses[b, c] @ poses[a, b]).distance_to(poses[a, c], np.array([[0.0, 0.0, 1.0]]))
        for pair in loop:
            gaps.setdefault(pair, []).append(gap)
    if not gaps:
        return dict(links)
    usual = np.median(np.concatenate(list(gaps.values())), axis=0)
    strays = {
        pair
        for pair, own in gaps.items()
        if len(own) >= FEWEST_LOOPS and (np.median(own, axis=0) > STRAY * usual).any()
    }
    doubt = "contradicted: its loops close far worse than those of other pairs"
    return {pair: replace(link, doubt=doubt) if pair in strays else link for pair, link in links.items()}


def _loops(poses: Mapping[Pair, Pose]) -> Iterator[tuple[Pair, Pair, Pair]]:
    """Yield (a, b), (b, c), (a, c) of all three views whose pairs all have a pose."""
    views = sorted({view for pair in poses for view in pair})
    for a, b, c in combinations(views, 3):
        if {(a, b), (b, c), (a, c)} <= poses.keys():
            yield (a, b), (b, c), (a, c)


def starts(links: Links, views: int) -> dict[Pair, Pose]:
    """Return where the network puts every pair (a < b) that it connects, along the firmest path."""
    poses = trusted(links)
    found: dict[Pair, Pose] = {}
    for view in range(views):
        found.update({(view, other): pose for other, pose in _reached(view, poses).items() if view < other})
    return found


def _reached(start: int, poses: Mapping[Pair, Pose]) -> dict[int, Pose]:
    """Return the pose of `start` in every view that it is connected to: Dijkstra, links as long as their variance."""
    reached: dict[int, Pose] = {}
    waiting: list[tuple[float, int, int]] = [(0.0, start, start)]
    while waiting:
        so_far, view, before = heappop(waiting)
        if view in reached:
            continue
        reached[view] = Pose() if view == before else poses[before, view] @ reached[before]
        for (a, b), pose in poses.items():
            if a == view and b not in reached:
                heappush(waiting, (so_far + held_to_m(pose) ** 2, b, view))
    return reached
