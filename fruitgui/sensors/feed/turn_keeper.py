"""Who may shine now: sensors that blind each other take turns, by what each of them confirms.

A sensor shines only after every other one that may not shine with it has confirmed to be dark. No thread of its own:
each sensor's reader asks what to do next.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum, auto

from fruitgui.sensors.feed.lit import Lit
from fruitgui.sensors.turns import Schedule

LONGEST_TURN_S = 1.0
"""A sensor whose frames do not come, or are damaged, gives its turn up after so long, or three times a usual turn."""


class Order(Enum):
    """What a reader is to do next with its sensor."""

    ON = auto()
    OFF = auto()
    READ = auto()
    REST = auto()


@dataclass(slots=True)
class _Turn:
    """A sensor that shines, or may shine; until its projector confirms to be on `on_s` is when it was told so."""

    plan: int
    slot: tuple[str, ...]
    on_s: float
    frames: int = 0
    kept: int = 0


class TurnKeeper:
    """Keeps a schedule. Any thread may call; no call waits longer than it is told to."""

    def __init__(self, schedule: Schedule) -> None:
        self._schedule = schedule
        self._rehearsed = False
        self._plan = 0
        self._changed = threading.Condition()
        self._hangs: dict[str, Callable[[], bool]] = {}
        self._ready: set[str] = set()
        self._lit: dict[str, _Turn] = {}
        self._done: set[str] = set()
        self._doubted: set[str] = set()
        self._slot = 0

    @property
    def schedule(self) -> Schedule:
        """What is kept to now."""
        return self._schedule

    def keep_to(self, schedule: Schedule, *, rehearsed: bool = False) -> None:
        """Keep to another schedule from now on; whoever shines now ends its turn first."""
        with self._changed:
            self._schedule, self._rehearsed = schedule, rehearsed
            self._plan += 1
            self._slot = 0
            self._done.clear()
            self._changed.notify_all()

    def admit(self, sensor: str, hangs: Callable[[], bool]) -> None:
        """Let a sensor take part that has started in the dark.

        Args:
            sensor: its id.
            hangs: tells whether its driver does not come back.
        """
        with self._changed:
            self._hangs[sensor] = hangs
            self._ready.add(sensor)
            self._changed.notify_all()

    def dismiss(self, sensor: str) -> None:
        """Let a sensor no longer take part: its device was given back."""
        with self._changed:
            self._ready.discard(sensor)
            self._lit.pop(sensor, None)
            self._changed.notify_all()

    def lose(self, sensor: str) -> None:
        """Let a sensor no longer take part that cannot be told to be dark: it may shine on until its next turn ends."""
        with self._changed:
            if sensor in self._lit:
                self._doubted.add(sensor)
        self.dismiss(sensor)

    def order(self, sensor: str, timeout_s: float) -> Order:
        """Return what a sensor that takes part is to do; `REST` where its turn does not come in time."""
        until_s = time.monotonic() + timeout_s
        with self._changed:
            while True:
                self._go_on()
                turn = self._lit.get(sensor)
                if turn is not None:
                    return Order.READ if self._may_stay(sensor, turn) else Order.OFF
                if self._may_shine(sensor):
                    # From here on it may shine, whatever becomes of the call that switches it on.
                    self._lit[sensor] = _Turn(self._plan, self._slot_now(sensor), time.monotonic())
                    return Order.ON
                left_s = until_s - time.monotonic()
                if left_s <= 0.0:
                    return Order.REST
                self._changed.wait(left_s)

    def shines(self, sensor: str) -> None:
        """Note that a projector confirmed to be on."""
        with self._changed:
            turn = self._lit.get(sensor)
            if turn is not None:
                turn.on_s = time.monotonic()

    def is_dark(self, sensor: str) -> None:
        """Note that a projector confirmed to be off: the turn is over."""
        with self._changed:
            turn = self._lit.pop(sensor, None)
            self._doubted.discard(sensor)
            if turn is not None and turn.plan == self._plan:
                self._done.add(sensor)
            self._changed.notify_all()

    def light(self, sensor: str, now_s: float) -> Lit | None:
        """Return how a frame of a sensor that came now was lit; None where it should be dark by now."""
        with self._changed:
            turn = self._lit.get(sensor)
            if turn is None or turn.plan != self._plan:
                return None
            turn.frames += 1
            since_s, settling = now_s - turn.on_s, self._schedule.settling(sensor)
            settled = since_s >= settling.settle_s and turn.frames > settling.discard_frames
            others = tuple(other for other in self._lit if other != sensor)
            return Lit(since_s, turn.frames - 1, others, settled, self._rehearsed)

    def keep(self, sensor: str) -> None:
        """Count a frame that was of use."""
        with self._changed:
            turn = self._lit.get(sensor)
            if turn is not None:
                turn.kept += 1

    def blinding(self, sensor: str) -> tuple[str, ...]:
        """Return those that may shine while a sensor has its turn, though they should not: their drivers hang.

        A driver that hangs may have left its projector on for good, or have lost a device that is dark. For as long as
        an honest call may take the others wait; then a belt seen badly is better than one seen by nobody.
        """
        with self._changed:
            if not self._schedule.alternates(sensor):
                return ()
            turn = self._lit.get(sensor)
            mates = (sensor,) if turn is None else turn.slot
            hung = (other for other in self._lit if self._hangs[other]())
            return tuple(other for other in sorted({*hung, *self._doubted}) if other not in mates)

    # all of the following with the lock held

    def _go_on(self) -> None:
        """Pass to the next slot in which somebody waits, once everybody in this one had its turn."""
        slots = self._schedule.slots
        if len(slots) < 2 or any(sensor not in self._done and self._is_there(sensor) for sensor in slots[self._slot]):
            return
        after = [(self._slot + step) % len(slots) for step in range(1, len(slots) + 1)]
        self._slot = next((slot for slot in after if any(map(self._is_there, slots[slot]))), self._slot)
        self._done.clear()
        self._changed.notify_all()

    def _may_shine(self, sensor: str) -> bool:
        if not self._schedule.alternates(sensor):
            return True
        slot = self._schedule.slots[self._slot]
        if sensor not in slot or sensor in self._done:
            return False
        return all(other in slot or not self._blinds(other) for other in self._lit)

    def _may_stay(self, sensor: str, turn: _Turn) -> bool:
        if turn.plan != self._plan:
            return False
        if not self._schedule.alternates(sensor):
            return True
        if sensor not in self._schedule.slots[self._slot]:
            return False
        lasts_s = time.monotonic() - turn.on_s
        usual_s = self._schedule.lights[sensor].turn_s(self._schedule.views)
        over = turn.kept >= self._schedule.views or lasts_s > max(LONGEST_TURN_S, 3.0 * usual_s)
        return not (over and self._others_wait())

    def _others_wait(self) -> bool:
        others = (slot for number, slot in enumerate(self._schedule.slots) if number != self._slot)
        return any(self._is_there(sensor) for slot in others for sensor in slot)

    def _is_there(self, sensor: str) -> bool:
        return sensor in self._ready and not self._hangs[sensor]()

    def _blinds(self, sensor: str) -> bool:
        """Tell whether a sensor that may shine is to be waited for: its driver answers, and it is in some slot."""
        return self._schedule.alternates(sensor) and not self._hangs[sensor]()

    def _slot_now(self, sensor: str) -> tuple[str, ...]:
        return self._schedule.slots[self._slot] if self._schedule.alternates(sensor) else (sensor,)
