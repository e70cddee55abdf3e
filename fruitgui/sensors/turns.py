"""Whose projector is on when: structured-light sensors that see the same place take turns.

A pure plan; a capture is timed by its own stamp, never by the plan.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass

VIEWS_NEEDED = 3
"""A fruit is to be seen this often by each sensor that it passes."""


@dataclass(frozen=True, slots=True)
class Schedule:
    """Slots that follow each other for ever.

    Attributes:
        slots: the sensors whose projectors are on together, slot by slot; none if there is no sensor.
        slot_s: how long one slot lasts.
    """

    slots: tuple[tuple[str, ...], ...]
    slot_s: float

    @property
    def cycle_s(self) -> float:
        """Time after which a sensor's turn comes again."""
        return len(self.slots) * self.slot_s

    @property
    def rate_hz(self) -> float:
        """Captures per second of each sensor."""
        return 1.0 / self.cycle_s if self.slots else 0.0

    def slot_at(self, time_s: float) -> int:
        """Return the number of the slot that is on at a time since the start."""
        return int(time_s // self.slot_s) % len(self.slots)

    def sensors_at(self, time_s: float) -> tuple[str, ...]:
        """Return the sensors whose projectors are on at a time since the start."""
        return self.slots[self.slot_at(time_s)] if self.slots else ()

    def next_turn_s(self, sensor: str, time_s: float) -> float:
        """Return when, at `time_s` or after it, a turn of a sensor begins.

        Raises:
            KeyError: the sensor has no slot.
        """
        slot = next((number for number, sensors in enumerate(self.slots) if sensor in sensors), None)
        if slot is None:
            raise KeyError(sensor)
        first_s = slot * self.slot_s
        cycles = max(-((first_s - time_s) // self.cycle_s), 0.0)
        return first_s + cycles * self.cycle_s

    def highest_belt_speed_m_s(self, seen_length_m: float, views: int = VIEWS_NEEDED) -> float:
        """Return the belt speed up to which each fruit is captured `views` times, wherever a turn begins.

        A fruit is in view for length / speed; that holds at least n captures, at
        whatever moment it enters, if it lasts n cycles.

        Args:
            seen_length_m: way along the belt on which a fruit is seen whole by one sensor.
            views: captures wanted of each fruit.
        """
        if not self.slots:
            return 0.0
        return max(seen_length_m, 0.0) / (views * self.cycle_s)


def turns(sensors: Sequence[str], overlaps: Iterable[Collection[str]] | None, period_s: float) -> Schedule:
    """Plan the turns: sensors that overlap never share a slot, and there are as few slots as greedy colouring finds.

    Colouring goes by the sensor with the most taken slots around it, then by
    the most neighbours (DSATUR, Brélaz 1979): exact for chains, rings and other
    bipartite rigs.

    Args:
        sensors: ids, each once.
        overlaps: pairs of ids whose sensors see the same place; None before that is known: each alone.
        period_s: time between captures: how long one slot lasts.

    Raises:
        ValueError: a period that is not positive, an id twice, or a pair that names no two sensors.
    """
    if not period_s > 0:
        raise ValueError(f"the period must be positive, not {period_s}")
    if len(set(sensors)) != len(sensors):
        raise ValueError("a sensor is named twice")
    if overlaps is None:
        return Schedule(tuple((sensor,) for sensor in sensors), period_s)
    slot_of = _colored(_neighbours(sensors, overlaps))
    count = max(slot_of.values(), default=-1) + 1
    slots = (tuple(sensor for sensor in sensors if slot_of[sensor] == slot) for slot in range(count))
    return Schedule(tuple(slots), period_s)


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
