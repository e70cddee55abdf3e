"""The line on live sensors: three threads and helping processes between a feed and a store of fruit."""

from __future__ import annotations

import queue
import statistics
import threading
import time
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial

from fruitgui.sensors.feed import ByCapture
from fruitgui.station.lineup import line_up
from fruitgui.station.live.bench import Bench
from fruitgui.station.live.counting import Counts, count_all
from fruitgui.station.live.finishing import Finishing
from fruitgui.station.live.first_look import FirstLook, Leaving
from fruitgui.station.live.following import Following
from fruitgui.station.live.helper import Skills
from fruitgui.station.live.intake import LIVE, ClockWatch, Intake
from fruitgui.station.live.perceiving import Perceived, Perceiving
from fruitgui.station.live.pictures import Arrivals, Pictures
from fruitgui.station.live.sensor_watch import SensorWatch
from fruitgui.station.live.showing import Showing
from fruitgui.station.live.state import LiveState, LiveWarning, Phase, Preview
from fruitgui.station.live.warnings import Warnings
from fruitgui.station.live.weighing import Weighing, Weighings
from fruitgui.station.model import Model
from fruitgui.station.station import Station

PERCEIVED_AHEAD = 6
"""Frames that may be perceived, or be with helpers, before the one that is to be followed next."""

FRUIT_AHEAD = 64
"""Fruit that wait to be measured and kept before the line waits for them."""

LATENCIES = 30
TAKE_S = 0.2
STOP_S = 15.0
HURRY_S = 3.0
"""For fruit that are not measured when the time to stop is over: they are sized roughly, which takes no time."""


class LiveLine:
    """Follows, measures, names and counts the fruit that a feed's sensors see, from `start` to `stop`.

    Constructing starts nothing; one owner starts and stops. `state` and `previews` may be read from any thread and
    never wait. A frame that cannot be used is said and skipped; a fruit that cannot be measured is said and counted.

    Args:
        feed: runs the sensors; started and stopped by its own owner.
        station: that the sensors belong to.
        model: names and corrects; without one every kind is `unknown`.
        counting: keeps finished fruit and counts them.
        lot: into which fruit are counted; None lets them pass uncounted.
        intake: how frames get in.

    Raises:
        InputError: the station has none of the sensors.
    """

    def __init__(
        self,
        feed: Pictures,
        station: Station,
        model: Model | None,
        counting: Counts,
        lot: int | None = None,
        intake: Intake = LIVE,
    ) -> None:
        self._feed = feed
        self._intake = intake
        self._lot = lot
        self._lineup = line_up(station, feed.infos.values())
        skills = Skills(self._lineup.eyes, self._lineup.rig, model)
        self._bench = Bench(skills)
        self._warnings = Warnings(self._lineup.warnings)
        self._perceiving = Perceiving(
            self._lineup, self._bench, skills.worker(), self._shift, ClockWatch(intake.jump_s), self._warnings
        )
        self._following = Following(self._lineup.rig, station, self._bench)
        self._showing = Showing(self._following)
        self._first_look = FirstLook(self._following)
        self._put_right: set[str] = set()
        self._sensors = SensorWatch(self._lineup.station_id, self._following.above, intake.away, self._warnings.add)
        self._finishing = Finishing(self._lineup.rig, skills.worker(), self._warnings.add)
        self._counting = counting
        self._perceived: queue.Queue[Perceived | None] = queue.Queue(PERCEIVED_AHEAD)
        self._parted: queue.Queue[Leaving | None] = queue.Queue(FRUIT_AHEAD)
        self._weighings = Weighings(self._parted, self._bench)
        self._subscription: Arrivals | None = None
        self._threads: tuple[threading.Thread, ...] = ()
        self._latencies: deque[float] = deque(maxlen=LATENCIES)
        self._phase = Phase.STOPPED
        self._frames = self._skipped = 0

    def start(self) -> None:
        """Start. Once only: make a new line to start again."""
        order = ByCapture(self._lineup.offsets_s, self._intake.patience_s)
        self._subscription = self._feed.subscribe(self._intake.room, order)
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
        """Stop: what waits is followed, what is in view is counted. Return whether all of it was.

        Args:
            timeout_s: fruit that are not measured by then are sized roughly, within some three seconds more.
        """
        if self._phase is Phase.RUNNING:
            self._phase = Phase.STOPPING
        if self._subscription is not None:
            self._subscription.close()
        if not self.wait(timeout_s):
            self._finishing.hurry()
        self._bench.close()
        done = self.wait(HURRY_S)
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
            self._showing.drawn,
            phase=self._phase,
            lot=self._lot,
            counted=self._counting.counted,
            passed=self._counting.passed,
            last=self._counting.last,
            health=tuple(self._feed.health(sensor) for sensor in self._feed.sensors),
            frames=self._frames,
            latency_s=statistics.median(self._latencies or (0.0,)),
            backlog=(subscription.waiting if subscription else 0) + self._perceived.qsize(),
            waiting_fruit=self._first_look.held + self._weighings.waiting + self._counting.sink_state.waiting,
            dropped=subscription.dropped if subscription else {},
            skipped=self._skipped,
            blind=self._sensors.blind,
            sparse=self._sensors.sparse,
            sink=self._counting.sink_state,
            warnings=self.warnings,
        )

    @property
    def previews(self) -> dict[str, Preview]:
        """The newest picture of each sensor, by its id in the feed."""
        return dict(self._showing.previews)

    @property
    def warnings(self) -> tuple[LiveWarning, ...]:
        """What a person should know."""
        stale = self._following.stale.items()
        bumped = (LiveWarning("calibration_stale", text, names) for names, text in stale)
        return (*bumped, *self._warnings.all(), *self._counting.warnings)

    # The first thread: frames in order, perceived by helpers, or here where there are none.

    def _perceive_all(self) -> None:
        subscription = self._subscription
        assert subscription is not None  # noqa: S101 - made before this thread was started
        try:
            while not subscription.over:
                arrival = subscription.take(TAKE_S)
                self._watch_sensors()
                if arrival is not None and arrival.frame.sensor in self._lineup.eyes:
                    self._perceived.put(self._perceiving.begin(arrival))
        finally:
            self._perceived.put(None)

    def _watch_sensors(self) -> None:
        self._watch(partial(self._sensors.look, self._feed.health, time.monotonic()))

    def _watch(self, look: Callable[[], None]) -> None:
        try:
            look()
        except Exception as error:  # noqa: BLE001 - the line goes on without; it is said
            self._warnings.add("not_watched", f"Whether every sensor gives pictures is not known: {error}", ())

    # The second thread: fruit followed.

    def _follow_all(self) -> None:
        try:
            while (perceived := self._perceived.get()) is not None:
                self._let_go(self._followed(perceived))
            remaining = self._remaining()
            self._let_go(remaining)
            self._look_on(remaining, tuple(self._lineup.eyes), partial(self._showing.draw, None))
        finally:
            self._parted.put(None)

    def _let_go(self, leaving: list[Leaving]) -> None:
        """Hand fruit on to be counted."""
        for one in leaving:
            self._parted.put(one)

    def _remaining(self) -> list[Leaving]:
        """Return the fruit that still wait for the clocks to be judged, or are in view, when no more is to come."""
        leaving: list[Leaving] = []
        for rest in (self._settled, self._first_look.released, self._in_view):
            try:
                leaving += rest()
            except Exception as error:  # noqa: BLE001 - the others are counted all the same; it is said
                text = f"Fruit that were in view at the end may not be counted: {error}"
                self._warnings.add("fruit_not_counted", text, ())
        return leaving

    def _settled(self) -> list[Leaving]:
        leaving = self._first_look.settle()
        self._put_clocks_right()
        return leaving

    def _in_view(self) -> list[Leaving]:
        return [(parted, self._lot) for parted in self._following.finish()]

    def _followed(self, perceived: Perceived) -> list[Leaving]:
        sensor = perceived.frame.sensor
        leaving: list[Leaving] = []
        try:
            observation = self._first_look.right(self._perceiving.observation(perceived))
            parted = self._following.follow(perceived.frame, observation, time.monotonic())
            leaving = self._first_look.take(observation, parted, self._lot)
            self._put_clocks_right()
        except Exception as error:  # noqa: BLE001 - one frame must not end the line; it is said
            self._skip(sensor, error)
            return leaving
        self._frames += 1
        self._latencies.append(time.monotonic() - perceived.arrival.arrived_s)
        self._watch(partial(self._sensors.see, observation.sensor, perceived.look.time_s, self._following.velocity_m_s))
        self._look_on(leaving, (sensor,), partial(self._showing.show, perceived.arrival, observation))
        return leaving

    def _skip(self, sensor: str, error: Exception) -> None:
        self._skipped += 1
        self._warnings.add("frame_skipped", f"A frame of sensor {sensor} could not be used: {error}", (sensor,))

    def _put_clocks_right(self) -> None:
        """Let frames leave the queue in the order of clocks put right, once the first look has found how."""
        for sensor, name in self._lineup.station_id.items():
            offset_s = self._first_look.offsets_s.get(name)
            if offset_s is not None and name not in self._put_right:
                self._put_right.add(name)
                self._shift({sensor: offset_s})
                text = f"The clock of sensor {name} is off by {offset_s:+.3f} s, judged by the fruit that both sensors "
                self._warnings.add(
                    "clock_put_right", text + "saw; it was put right before any fruit was counted.", (name,)
                )

    def _shift(self, offsets_s: Mapping[str, float]) -> None:
        """Let frames of sensors leave the queue as if their stamps were later by so much."""
        if self._subscription is not None:
            self._subscription.shift(offsets_s)

    def _look_on(self, leaving: list[Leaving], sensors: tuple[str, ...], draw: Callable[[], None]) -> None:
        """Watch by the fruit that left whether the rig was bumped, and draw."""
        try:
            for parted, _ in leaving:
                self._following.see_off(parted)
            draw()
        except Exception as error:  # noqa: BLE001 - fruit are counted all the same; it is said
            self._warnings.add("not_drawn", f"What is counted could not be drawn: {error}", sensors)

    # The third thread: fruit measured, kept, counted.

    def _count_all(self) -> None:
        count_all(self._weighings.take, self._count, self._counting.retry, self._warnings.add)
        if self._phase is Phase.RUNNING:
            self._phase = Phase.ENDED

    def _count(self, weighing: Weighing) -> None:
        self._counting.count(self._finishing.finish(weighing), weighing.lot)
