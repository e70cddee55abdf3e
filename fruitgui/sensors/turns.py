"""Whose projector is on when: structured-light sensors that see the same place take turns.

A pure plan. A feed keeps to it, by what the sensors confirm and not by the clock; a capture is timed by its own stamp.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from fruitgui.sensors.sensor import Projector, SensorInfo

USUAL_HZ = 30.0
"""Of a sensor that does not say how many frames a second it gives."""

VIEWS_NEEDED = 3
"""A fruit is to be seen this often by each sensor that it passes."""

VIEWS_A_TURN = 3
"""Frames kept of each turn. The way to the light's steadiness is the dear part of a turn: with as many frames as each
fruit needs, no fruit waits longer than one round for all of its views."""


@dataclass(frozen=True, slots=True)
class Settling:
    """How long a device's depth is of no use after its projector was switched on; both must have passed.

    Attributes:
        settle_s: time.
        discard_frames: frames.
    """

    settle_s: float = 0.150
    discard_frames: int = 3


@dataclass(frozen=True, slots=True)
class Light:
    """What is known of one sensor that takes turns.

    Attributes:
        period_s: between its frames while it shines, > 0.
        settling: after its projector was switched on.
        switch_s: that switching on and off takes, together; a Kinect v1's five control requests over USB 2.
    """

    period_s: float
    settling: Settling = Settling()
    switch_s: float = 0.020

    def turn_s(self, views: int) -> float:
        """Return how long a turn lasts: switching, settling, and `views` frames, the first of them a period later."""
        settled_s = max(self.settling.settle_s, self.settling.discard_frames * self.period_s)
        return self.switch_s + settled_s + views * self.period_s


@dataclass(frozen=True, slots=True)
class Schedule:
    """Slots that follow each other for ever. A sensor in no slot is nobody's concern: its projector is always on.

    Attributes:
        slots: the sensors whose projectors are on together, slot by slot.
        lights: of each sensor in a slot.
        views: frames that a sensor keeps of each turn.
    """

    slots: tuple[tuple[str, ...], ...] = ()
    lights: Mapping[str, Light] = field(default_factory=dict)
    views: int = VIEWS_A_TURN

    @property
    def cycle_s(self) -> float:
        """Time after which a sensor's turn comes again."""
        return sum(max(self.lights[sensor].turn_s(self.views) for sensor in slot) for slot in self.slots)

    def alternates(self, sensor: str) -> bool:
        """Tell whether a sensor has to be dark at times."""
        return len(self.slots) > 1 and any(sensor in slot for slot in self.slots)

    def settling(self, sensor: str) -> Settling:
        """Return how a sensor settles; one that never goes dark does so once."""
        light = self.lights.get(sensor)
        return Settling() if light is None else light.settling

    def rate_hz(self, sensor: str, nominal_hz: float) -> float:
        """Return a sensor's frames per second, where it gives `nominal_hz` while it shines."""
        return self.views / self.cycle_s if self.alternates(sensor) else nominal_hz

    def longest_wait_s(self, sensor: str, nominal_hz: float, views: int = VIEWS_NEEDED) -> float:
        """Return within which time a sensor has given `views` frames for certain, whenever one begins to count."""
        if not self.alternates(sensor):
            return views / nominal_hz
        period_s, cycle_s = self.lights[sensor].period_s, self.cycle_s
        waits_s = []
        for missed in range(self.views):  # one begins to count just after this frame of a turn
            turns_on, frame = divmod(missed + views, self.views)
            waits_s.append(turns_on * cycle_s + (frame - missed) * period_s)
        return max(waits_s)


def lights_of(infos: Iterable[SensorInfo], settlings: Mapping[str, Settling] | None = None) -> dict[str, Light]:
    """Return the lights of those sensors that blind others and can be switched, in order.

    Args:
        infos: of all sensors.
        settlings: as measured, by serial; the usual where not.
    """
    known = settlings or {}
    return {
        info.sensor: Light(1.0 / (info.rate_hz or USUAL_HZ), known.get(info.serial, Settling()))
        for info in infos
        if info.projector is Projector.SWITCHED
    }


def turns(
    lights: Mapping[str, Light], overlaps: Iterable[Collection[str]] | None, views: int = VIEWS_A_TURN
) -> Schedule:
    """Plan the turns: sensors that overlap never share a slot, and there are as few slots as greedy colouring finds.

    Colouring goes by the sensor with the most taken slots around it, then by
    the most neighbours (DSATUR, Brélaz 1979): exact for chains, rings and other
    bipartite rigs. A sensor that overlaps with none has no slot.

    Args:
        lights: the sensors that blind others, in order.
        overlaps: pairs of ids whose sensors see the same place; None before that is known: each alone.
        views: frames that a sensor keeps of each turn.

    Raises:
        ValueError: a period that is not positive, no views, or a pair that names no two of the sensors.
    """
    if not all(light.period_s > 0 for light in lights.values()) or views < 1:
        raise ValueError("periods and views must be positive")
    sensors = tuple(lights)
    if overlaps is None:
        return Schedule(tuple((sensor,) for sensor in sensors) if len(sensors) > 1 else (), dict(lights), views)
    neighbours = _neighbours(sensors, overlaps)
    slot_of = _colored({sensor: others for sensor, others in neighbours.items() if others})
    count = max(slot_of.values(), default=-1) + 1
    slots = (tuple(sensor for sensor in sensors if slot_of.get(sensor) == slot) for slot in range(count))
    return Schedule(tuple(slots), dict(lights), views)


def _neighbours(sensors: Sequence[str], overlaps: Iterable[Collection[str]]) -> dict[str, set[str]]:
    neighbours: dict[str, set[str]] = {sensor: set() for sensor in sensors}
    for pair in overlaps:
        ends = set(pair)
        if len(ends) != 2 or not ends <= neighbours.keys():
            raise ValueError(f"not a pair of sensors: {sorted(ends)}")
        first, second = ends
        neighbours[first].add(second)
        neighbours[second].add(first)
    return neighbours


def _colored(neighbours: Mapping[str, set[str]]) -> dict[str, int]:
    """Return a slot for each sensor, none shared by neighbours (DSATUR)."""
    order = {sensor: place for place, sensor in enumerate(neighbours)}
    slot_of: dict[str, int] = {}
    while len(slot_of) < len(neighbours):
        sensor = max(
            (one for one in neighbours if one not in slot_of),
            key=lambda one: (len(_taken(one, neighbours, slot_of)), len(neighbours[one]), -order[one]),
        )
        taken = _taken(sensor, neighbours, slot_of)
        slot_of[sensor] = next(slot for slot in range(len(neighbours)) if slot not in taken)
    return slot_of


def _taken(sensor: str, neighbours: Mapping[str, set[str]], slot_of: Mapping[str, int]) -> set[int]:
    return {slot_of[other] for other in neighbours[sensor] if other in slot_of}
