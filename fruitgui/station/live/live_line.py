"""The line on live sensors: three threads and helping processes between a feed and a store of fruit."""

from __future__ import annotations

import queue
import statistics
import threading
import time
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass, replace
from typing import Any

from fruitgui.frame import Frame
from fruitgui.perception.view import Observation
from fruitgui.sensors.feed import Arrival, ByCapture, Feed, Subscription
from fruitgui.station.lineup import line_up
from fruitgui.station.live.bench import Bench
from fruitgui.station.live.counting import Counting, Teacher
from fruitgui.station.live.first_look import FirstLook, Leaving
from fruitgui.station.live.following import Following
from fruitgui.station.live.helper import Hands, HelperLostError, JobError, Look, attempted
from fruitgui.station.live.intake import LIVE, ClockWatch, Intake
from fruitgui.station.live.sensor_watch import SensorWatch
from fruitgui.station.live.state import LiveState, LiveWarning, Phase, Preview
from fruitgui.station.live.warnings import Warnings
from fruitgui.station.model import Model
from fruitgui.station.station import Station
from fruitgui.station.waiting import BufferedSink

PERCEIVED_AHEAD = 6
"""Frames that may be perceived, or be with helpers, before the one that is to be followed next."""

FRUIT_AHEAD = 64
"""Fruit that wait to be measured and kept before the line waits for them."""

SHOWN_HZ = 25.0
"""States are made no more often: nobody sees more."""

LATENCIES = 30
TAKE_S, RETRY_S = 0.2, 2.0
STOP_S = 15.0


@dataclass(frozen=True, slots=True, eq=False)
class _Perceived:
    """One frame on its way: what was perceived in it, once that is done."""

    arrival: Arrival
    frame: Frame
    look: Look
    answer: Future[Any]


class LiveLine:
    """Follows, measures, names and counts the fruit that a feed's sensors see, from `start` to `stop`.

    Constructing starts nothing; one owner starts and stops. `state` and `previews` may be read from any thread and
    never wait. A frame that cannot be used is said and skipped; a fruit that cannot be measured is said and counted.

    Args:
        feed: runs the sensors; started and stopped by its own owner.
        station: that the sensors belong to.
        model: names and corrects; without one every kind is `unknown`.
        sink: keeps fruit; what it returns is counted.
        lot: into which fruit are counted; None lets them pass uncounted.
        intake: how frames get in.
        teacher: told of every fruit that left, on the line's thread.

    Raises:
        InputError: the station has none of the sensors.
    """

    def __init__(
        self,
        feed: Feed,
        station: Station,
        model: Model | None,
        sink: BufferedSink,
        lot: int | None = None,
        intake: Intake = LIVE,
        teacher: Teacher | None = None,
    ) -> None:
        self._feed = feed
        self._intake = intake
        self._lot = lot
        self._lineup = line_up(station, feed.infos.values())
        hands = Hands(self._lineup.eyes, self._lineup.rig, model)
        self._bench = Bench(hands)
        self._looker = hands.worker()
        self._order = ByCapture(self._lineup.offsets_s, intake.patience_s)
        self._clocks = ClockWatch(intake.jump_s)
        self._warnings = Warnings(self._lineup.warnings)
        self._following = Following(self._lineup.rig, station, self._bench)
        self._first_look = FirstLook(self._following)
        self._put_right: set[str] = set()
        self._leaps_s = dict(self._lineup.offsets_s)
        self._sensors = SensorWatch(self._lineup.station_id, self._following.above, intake.away, self._warnings.add)
        self._counting = Counting(self._lineup.rig, hands.worker(), self._bench, sink, teacher, self._warnings.add)
        self._perceived: queue.Queue[_Perceived | None] = queue.Queue(PERCEIVED_AHEAD)
        self._parted: queue.Queue[Leaving | None] = queue.Queue(FRUIT_AHEAD)
        self._subscription: Subscription | None = None
        self._threads: tuple[threading.Thread, ...] = ()
        self._latencies: deque[float] = deque(maxlen=LATENCIES)
        self._previews: dict[str, Preview] = {}
        self._drawn = LiveState(Phase.STOPPED)
        self._phase = Phase.STOPPED
        self._frames = self._skipped = 0
        self._shown_s = 0.0
        self._preview_due_s: dict[str, float] = {}

    def start(self) -> None:
        """Start. Once only: make a new line to start again."""
        self._subscription = self._feed.subscribe(self._intake.room, self._order)
        self._phase = Phase.RUNNING
        self._bench.start()
        runs: tuple[tuple[str, Callable[[], None]], ...] = (
            ("line perceives", self._perceive_all),
            ("line follows", self._follow_all),
            ("line counts", self._count_all),
        )
        self._threads = tuple(threading.Thread(target=run, name=name, daemon=True) for name, run in runs)
        for thread in self._threads:
            thread.start()

    def count_into(self, lot: int | None) -> None:
        """Count fruit that leave from now on into a lot; None lets them pass uncounted: a pause."""
        self._lot = lot

    def stop(self, timeout_s: float = STOP_S) -> bool:
        """Stop: what waits is followed, what is in view is counted. Return whether all of it was, in that time."""
        if self._phase is Phase.RUNNING:
            self._phase = Phase.STOPPING
        if self._subscription is not None:
            self._subscription.close()
        done = self.wait(timeout_s)
        self._bench.close()
        self._phase = Phase.STOPPED
        return done

    def wait(self, timeout_s: float) -> bool:
        """Wait until the line has ended by itself (its recordings are over); return whether it has."""
        until_s = time.monotonic() + timeout_s
        for thread in self._threads:
            thread.join(max(until_s - time.monotonic(), 0.0))
        return not any(thread.is_alive() for thread in self._threads)

    @property
    def state(self) -> LiveState:
        """How the line is: what is in view as of the last observation, everything else as of now."""
        subscription = self._subscription
        return replace(
            self._drawn,
            phase=self._phase,
            lot=self._lot,
            totals=self._counting.totals,
            last=self._counting.last,
            health=tuple(self._feed.health(sensor) for sensor in self._feed.sensors),
            frames=self._frames,
            latency_s=statistics.median(self._latencies or (0.0,)),
            backlog=(subscription.waiting if subscription else 0) + self._perceived.qsize(),
            waiting_fruit=self._first_look.held + self._parted.qsize() + self._counting.sink_state.waiting,
            dropped=subscription.dropped if subscription else {},
            skipped=self._skipped,
            blind=self._sensors.blind,
            sink=self._counting.sink_state,
            warnings=self.warnings,
        )

    @property
    def previews(self) -> dict[str, Preview]:
        """The newest picture of each sensor, by its id in the feed."""
        return dict(self._previews)

    @property
    def warnings(self) -> tuple[LiveWarning, ...]:
        """What a person should know."""
        stale = self._following.stale.items()
        return (*(LiveWarning("calibration_stale", text, names) for names, text in stale), *self._warnings.all())

    # The first thread: frames in order, perceived by helpers, or here where there are none.

    def _perceive_all(self) -> None:
        subscription = self._subscription
        assert subscription is not None  # noqa: S101 - made before this thread was started
        while not subscription.over:
            arrival = subscription.take(TAKE_S)
            self._sensors.look(self._feed.health, time.monotonic())
            if arrival is not None and arrival.frame.sensor in self._lineup.eyes:
                self._perceived.put(self._perceive(arrival))
        self._perceived.put(None)

    def _perceive(self, arrival: Arrival) -> _Perceived:
        frame = self._lineup.corrected(arrival.frame)
        self._watch_clock(arrival)
        look = Look(frame, self._time_s(frame))
        answer = self._bench.hand(look)
        if answer is None:
            answer = self._looked(look)
        return _Perceived(arrival, frame, look, answer)

    def _looked(self, look: Look) -> Future[Any]:
        """Perceive here."""
        done, error = attempted(self._looker, look)
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
            self._order.shift({sensor: leap_s})
            text = f"The clock of sensor {sensor} leapt by {-leap_s:+.1f} s; it is followed on from there."
            self._warnings.add("clock_jumped", text, (sensor,))

    # The second thread: fruit followed.

    def _follow_all(self) -> None:
        while (perceived := self._perceived.get()) is not None:
            self._let_go(self._followed(perceived))
        self._let_go(self._settled())
        self._let_go([(parted, self._lot) for parted in self._following.finish()])
        self._draw()
        self._parted.put(None)

    def _let_go(self, leaving: list[Leaving]) -> None:
        """Hand fruit on to be counted."""
        for parted, lot in leaving:
            self._following.see_off(parted)
            self._parted.put((parted, lot))

    def _followed(self, perceived: _Perceived) -> list[Leaving]:
        sensor = perceived.frame.sensor
        try:
            observation = self._first_look.right(self._observation(perceived))
            parted = self._following.follow(perceived.frame, observation, time.monotonic())
            leaving = self._first_look.take(observation, parted, self._lot)
            self._put_clocks_right()
        except Exception as error:  # noqa: BLE001 - one frame must not end the line; it is said
            self._skipped += 1
            self._warnings.add("frame_skipped", f"A frame of sensor {sensor} could not be used: {error}", (sensor,))
            return []
        self._frames += 1
        self._latencies.append(time.monotonic() - perceived.arrival.arrived_s)
        self._show(perceived.arrival, observation)
        return leaving

    def _observation(self, perceived: _Perceived) -> Observation:
        try:
            found: Observation = perceived.answer.result()
        except HelperLostError:
            again: Observation = self._looked(perceived.look).result()
            return again
        return found

    def _settled(self) -> list[Leaving]:
        """Return the fruit that still wait for the clocks to be judged, when no more is to come."""
        leaving = self._first_look.settle()
        self._put_clocks_right()
        return leaving

    def _put_clocks_right(self) -> None:
        """Let frames leave the queue in the order of clocks put right, once the first look has found how."""
        for sensor, name in self._lineup.station_id.items():
            offset_s = self._first_look.offsets_s.get(name)
            if offset_s is not None and name not in self._put_right:
                self._put_right.add(name)
                self._order.shift({sensor: offset_s})
                text = f"The clock of sensor {name} is off by {offset_s:+.3f} s, judged by the fruit that both sensors "
                self._warnings.add(
                    "clock_put_right", text + "saw; it was put right before any fruit was counted.", (name,)
                )

    def _show(self, arrival: Arrival, observation: Observation) -> None:
        now_s, sensor = time.monotonic(), arrival.frame.sensor
        due_s, period_s = self._preview_due_s.get(sensor, 0.0), 1.0 / SHOWN_HZ
        if now_s >= due_s:  # counted from when it was due, or frames nearly as far apart would leave out every other
            self._preview_due_s[sensor] = max(due_s, now_s - period_s) + period_s
            self._previews[sensor] = self._following.preview(arrival, observation.sensor)
        if now_s - self._shown_s >= 1.0 / SHOWN_HZ:
            self._shown_s = now_s
            self._draw(observation.time_s)

    def _draw(self, time_s: float | None = None) -> None:
        self._drawn = replace(
            self._drawn,
            time_s=self._drawn.time_s if time_s is None else time_s,
            tracks=self._following.tracks_now(),
            footprints_m=self._following.above.footprints_m,
            belt_velocity_m_s=self._following.velocity_m_s,
        )

    # The third thread: fruit measured, kept, counted.

    def _count_all(self) -> None:
        while True:
            try:
                leaving = self._parted.get(timeout=RETRY_S)
            except queue.Empty:
                self._counting.retry()
                continue
            if leaving is None:
                break
            self._count(leaving)
        self._counting.retry()
        if self._phase is Phase.RUNNING:
            self._phase = Phase.ENDED

    def _count(self, leaving: Leaving) -> None:
        parted, lot = leaving
        try:
            self._counting.count(parted, lot)
        except Exception as error:  # noqa: BLE001 - one fruit must not end the line; it is said
            self._warnings.add("fruit_not_counted", f"A fruit was followed but could not be counted: {error}", ())
