"""The beginning of the line: frames handed out to be perceived, with their depth and their clocks put right."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from concurrent.futures import Future
from dataclasses import dataclass
from typing import Any

from fruitgui.frame import Frame
from fruitgui.perception.view import Observation
from fruitgui.sensors.feed import Arrival
from fruitgui.station.lineup import Lineup
from fruitgui.station.live.bench import Bench
from fruitgui.station.live.helper import HelperLostError, JobError, Look, Worker, attempted
from fruitgui.station.live.intake import ClockWatch
from fruitgui.station.live.warnings import Warnings


@dataclass(frozen=True, slots=True, eq=False)
class Perceived:
    """One frame on its way.

    Attributes:
        arrival: as it came. frame: with its depth put right.
        look: what is to be perceived.
        answer: what was perceived, or why it could not be, once that is known.
    """

    arrival: Arrival
    frame: Frame
    look: Look
    answer: Future[Any]


class Perceiving:
    """Hands frames to helpers, or perceives itself where there are none. One thread calls `begin`, any `observation`.

    Args:
        lineup: the sensors.
        bench: the helpers.
        worker: perceives where no helper does.
        shift: told by how much a clock leapt, so that frames go on coming in order.
        clocks: watches for leaps.
        warnings: takes what a person should know.
    """

    def __init__(
        self,
        lineup: Lineup,
        bench: Bench,
        worker: Worker,
        shift: Callable[[Mapping[str, float]], None],
        clocks: ClockWatch,
        warnings: Warnings,
    ) -> None:
        self._lineup = lineup
        self._bench = bench
        self._worker = worker
        self._shift = shift
        self._clocks = clocks
        self._warnings = warnings
        self._leaps_s = dict(lineup.offsets_s)

    def begin(self, arrival: Arrival) -> Perceived:
        """Give a frame to be perceived; waits where all helpers are busy. What goes wrong is in the answer."""
        frame = arrival.frame
        look = Look(frame, frame.time_s)
        try:
            self._watch_clock(arrival)
            look = Look(self._lineup.corrected(frame), self._time_s(frame))
            answer = self._bench.hand(look) or self._looked(look)
        except Exception as error:  # noqa: BLE001 - one frame must not end the line; it is said when its turn comes
            answer = Future()
            answer.set_exception(error)
        return Perceived(arrival, look.frame, look, answer)

    def observation(self, perceived: Perceived) -> Observation:
        """Return what was perceived in a frame; waits for it.

        Raises:
            JobError: it could not be perceived.
        """
        try:
            found: Observation = perceived.answer.result()
        except HelperLostError:
            again: Observation = self._looked(perceived.look).result()
            return again
        return found

    def _looked(self, look: Look) -> Future[Any]:
        """Perceive here."""
        done, error = attempted(self._worker, look)
        answer: Future[Any] = Future()
        if error is None:
            answer.set_result(done)
        else:
            answer.set_exception(JobError(error))
        return answer

    def _time_s(self, frame: Frame) -> float:
        """Return a frame's capture time, before what the first look may find."""
        return frame.time_s + self._leaps_s.get(frame.sensor, 0.0)

    def _watch_clock(self, arrival: Arrival) -> None:
        sensor = arrival.frame.sensor
        leap_s = self._clocks.leap_s(sensor, self._time_s(arrival.frame), arrival.arrived_s)
        if leap_s:
            self._leaps_s[sensor] = self._leaps_s.get(sensor, 0.0) + leap_s
            self._shift({sensor: leap_s})
            text = f"The clock of sensor {sensor} leapt by {-leap_s:+.1f} s; it is followed on from there."
            self._warnings.add("clock_jumped", text, (sensor,))
