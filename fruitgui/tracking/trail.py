"""What is known of one fruit while it is followed: its sightings, thinned, and the evidence for it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from fruitgui.frame import F64
from fruitgui.perception.view import FruitView

NEIGHBOUR_M = 0.12
"""Centres farther apart than this belong to different fruit, whatever the frames say."""

TELLING_FRAMES = 4
"""A sensor that saw two tracks less often, say at the edge of its picture, has no word in whether they are two."""

STANDING_M_S = 1e-3
"""While the belt stands, a second counts like a millimetre of way when sightings are thinned."""


@dataclass(frozen=True, slots=True, eq=False)
class Entry:
    """One sighting with what tracking needs of it, reference frame.

    Attributes:
        time_s: reference clock.
        view: what the sensor saw.
        position_m: (3,) measured centre. covariance_m2: (3, 3) of it, pose errors left out.
        travelled_m: (3,) the belt's displacement at that time.
        cut: cut by the edge of the picture or of the region.
    """

    time_s: float
    view: FruitView
    position_m: F64
    covariance_m2: F64
    travelled_m: F64
    cut: bool


@dataclass(slots=True, eq=False)
class Company:
    """What frames said about two tracks that lie close together.

    Attributes:
        both: frames that showed them as two views.
        one: frames that showed one of them only.
        merged: frames in which one view covered both.
        by_sensor: of each sensor's frames, how many showed them as two views, and how many said anything.
    """

    both: int = 0
    one: int = 0
    merged: int = 0
    by_sensor: dict[str, tuple[int, int]] = field(default_factory=dict)

    def note(self, sensor: str, both: bool, one: bool, merged: bool) -> None:
        """Count one frame."""
        self.both += both
        self.one += one
        self.merged += merged
        apart, telling = self.by_sensor.get(sensor, (0, 0))
        self.by_sensor[sensor] = apart + both, telling + 1

    def join(self, other: Company) -> None:
        """Add the record of a track that was the same fruit: a frame's `one` may have been the other's `both`."""
        both = self.both + other.both
        self.one = max(self.one + other.one - both, 0)
        self.both = both
        self.merged = max(self.merged, other.merged)
        for sensor, (apart, telling) in other.by_sensor.items():
            own = self.by_sensor.get(sensor, (0, 0))
            self.by_sensor[sensor] = own[0] + apart, max(own[1], telling)


@dataclass(slots=True, eq=False)
class Trail:
    """One fruit being followed, or just finished.

    Attributes:
        number: the track's id.
        first_s, last_s: first and last sighting.
        position_m: (3,) estimated centre at `now_s`. travelled_m: (3,) the belt's displacement then.
        entries: kept sightings, in order of arrival.
        views: all views. whole: of them, seen whole. clear: of them, not cut by an edge.
        shared: of them, cut out of a group.
        expected: frames that should have shown it. unseen: of them, the last ones in a row that did not.
        looks: (5,) running mean. size_m: running mean diameter.
        company: by the number of another track.
        surface_m: (n, 3) sample of the seen surface in the belt's frame, once the views are given away.
    """

    number: int
    first_s: float
    looks: F64
    size_m: float
    last_s: float = 0.0
    position_m: F64 = field(default_factory=lambda: np.zeros(3))
    travelled_m: F64 = field(default_factory=lambda: np.zeros(3))
    entries: list[Entry] = field(default_factory=list)
    views: int = 0
    whole: int = 0
    clear: int = 0
    shared: int = 0
    expected: int = 0
    unseen: int = 0
    company: dict[int, Company] = field(default_factory=dict)
    surface_m: F64 = field(default_factory=lambda: np.zeros((0, 3)))

    @property
    def place_m(self) -> F64:
        """Return where the fruit lies on the belt: its position less the belt's displacement, (3,)."""
        return self.position_m - self.travelled_m

    def see(self, entry: Entry, looks: F64, size_m: float, most: int) -> None:
        """Take a sighting; keep about `most` of them."""
        self.entries.append(entry)
        self.last_s = max(self.last_s, entry.time_s)
        self.views += 1
        self.unseen = 0
        self.whole += entry.view.whole
        self.clear += not entry.cut
        self.shared += entry.view.shared
        if not entry.cut or not self.clear:
            weight = max(1.0 / max(self.clear, 1), 0.05)
            self.looks = self.looks + weight * (looks - self.looks)
            self.size_m += weight * (size_m - self.size_m)
        if len(self.entries) > most + most // 4:
            self.entries = thinned(self.entries, most)

    def company_of(self, other: int) -> Company:
        """Return the record with another track, begun if there is none."""
        found = self.company.get(other)
        if found is None:
            found = self.company[other] = Company()
        return found

    def shown_beside(self, other: Trail) -> int:
        """Return how many frames showed this track and the other as two views."""
        return max(
            self.company.get(other.number, Company()).both,
            other.company.get(self.number, Company()).both,
        )

    def was_near(self, other: Trail) -> bool:
        """Return whether any frame that told something of both had them closer than `NEIGHBOUR_M`."""
        records = (self.company.get(other.number), other.company.get(self.number))
        return any(record is not None and record.by_sensor for record in records)

    def parted(self, other: Trail) -> float:
        """Return the share of frames that showed this track and the other as two views, by the sensor that says most.

        Two fruit are apart to a sensor that looks along the gap between them, even if to no other.
        """
        records = (self.company.get(other.number, Company()), other.company.get(self.number, Company()))
        fuller = max(records, key=lambda record: record.both + record.one + record.merged)
        shares = [apart / telling for apart, telling in fuller.by_sensor.values() if telling >= TELLING_FRAMES]
        return max(shares, default=0.0)

    def absorb(self, other: Trail, most: int) -> None:
        """Take over the sightings of a track that turned out to be this fruit."""
        frames = {(entry.view.sensor, entry.view.sequence) for entry in self.entries}
        fresh = [entry for entry in other.entries if (entry.view.sensor, entry.view.sequence) not in frames]
        share = len(fresh) / max(len(other.entries), 1)
        self.entries = thinned(sorted(self.entries + fresh, key=lambda entry: entry.time_s), most)
        self.views += round(share * other.views)
        self.whole += round(share * other.whole)
        self.clear += round(share * other.clear)
        self.shared += round(share * other.shared)
        self.first_s, self.last_s = min(self.first_s, other.first_s), max(self.last_s, other.last_s)
        self.expected = max(self.expected, other.expected)
        self.unseen = min(self.unseen, other.unseen)
        for number, company in other.company.items():
            if number != self.number:
                self.company_of(number).join(company)


def thinned(entries: Sequence[Entry], most: int) -> list[Entry]:
    """Return at most `most` entries in the same order, spread evenly along the way, each sensor's share kept.

    Where several lie close together the whole ones stay.
    """
    if len(entries) <= most:
        return list(entries)
    sensors = sorted({entry.view.sensor for entry in entries})
    kept: set[int] = set()
    left = most
    by_size = sorted(sensors, key=lambda sensor: sum(entry.view.sensor == sensor for entry in entries))
    for i, sensor in enumerate(by_size):
        own = [k for k, entry in enumerate(entries) if entry.view.sensor == sensor]
        share = left // (len(sensors) - i)
        chosen = own if len(own) <= share else _spread([entries[k] for k in own], own, share)
        kept.update(chosen)
        left -= len(chosen)
    return [entry for k, entry in enumerate(entries) if k in kept]


def _spread(entries: Sequence[Entry], numbers: Sequence[int], most: int) -> list[int]:
    """Return `most` of the numbers, one from each of as many equal stretches of the way, whole ones first."""
    travelled = np.array([entry.travelled_m for entry in entries])
    time_s = np.array([entry.time_s for entry in entries])
    step = np.linalg.norm(np.diff(travelled, axis=0), axis=1) + STANDING_M_S * np.abs(np.diff(time_s))
    way = np.concatenate([[0.0], np.cumsum(step)])
    stretch = np.minimum((way / max(way[-1], 1e-12) * most).astype(np.intp), most - 1)
    poor = np.array([not entry.view.whole for entry in entries])
    rank = np.empty(len(entries), dtype=np.intp)
    order = np.lexsort((time_s, poor, stretch))
    _, starts, counts = np.unique(stretch[order], return_index=True, return_counts=True)
    rank[order] = np.arange(len(entries)) - np.repeat(starts, counts)
    best = np.lexsort((time_s, poor, rank))[:most]
    return [numbers[int(k)] for k in best]
