"""A line in a process of its own, as its owner and a screen see it."""

from __future__ import annotations

import math
import queue
import threading
import time
from dataclasses import replace
from typing import Any

from fruitgui.errors import FruitguiError, WorldError
from fruitgui.sensors.feed import Arrival, Feed, SensorHealth, Subscription
from fruitgui.station.lineup import line_up
from fruitgui.station.live.apart.gallery import Gallery
from fruitgui.station.live.apart.messages import Drawn, Ended, Made, NotMade, Out, Pictured, Shifted, Start
from fruitgui.station.live.apart.process import Places
from fruitgui.station.live.apart.processes import Processes
from fruitgui.station.live.counting import Counting, count_all
from fruitgui.station.live.intake import LIVE, Intake
from fruitgui.station.live.live_line import FRUIT_AHEAD, HURRY_S, STOP_S, TAKE_S
from fruitgui.station.live.state import LiveState, LiveWarning, Phase, Preview
from fruitgui.station.live.warnings import Warnings
from fruitgui.station.model import Model
from fruitgui.station.station import Station

BEGIN_S = 60.0
"""A process that has not begun by then never will."""

GONE_S = 0.02
"""Between two tries to hand a frame to a line that is being begun again."""


class LineApart:
    """Does what `LiveLine` does, in another process: no Python of the line's keeps the window waiting.

    Sensors are read here, and fruit are kept here: what was given back is durable whatever becomes of the process. One
    that dies or hangs is begun again, and it is said; fruit that were in view then may be missing.

    Args:
        feed, station, model, counting, lot, intake: as of a `LiveLine`.

    Raises:
        InputError: the station has none of the sensors.
    """

    def __init__(
        self,
        feed: Feed,
        station: Station,
        model: Model | None,
        counting: Counting,
        lot: int | None = None,
        intake: Intake = LIVE,
    ) -> None:
        line_up(station, feed.infos.values())  # what it raises is raised here, not in the process
        self._feed, self._counting, self._lot = feed, counting, lot
        self._recipe = station, model, intake
        self._processes = Processes(_most_pixels(feed), self._start)
        self._warnings = Warnings()
        self._phase = Phase.STOPPED
        self._drawn = LiveState(Phase.STOPPED)
        self._gallery = Gallery()
        self._out: queue.Queue[Out | None] = queue.Queue(FRUIT_AHEAD)
        self._subscription: Subscription | None = None
        self._begun = threading.Event()
        self._why_not: FruitguiError | None = None
        self._counted = self._skipped = 0
        self._done = self._ended = self._gave_all = self._over = False
        self._until_s: float | None = None
        self._told_s = 0.0
        self._threads: tuple[threading.Thread, ...] = ()

    def start(self) -> None:
        """Start, and wait until the line is there. Once only.

        Raises:
            WorldError: there is no process to be had.
            FruitguiError: the line cannot be made.
        """
        try:
            self._processes.begin()
        except OSError as error:
            self._processes.give_back()
            raise _not_started(str(error)) from error
        self._phase = Phase.RUNNING
        runs = (("line gives", self._give_all), ("line hears", self._hear_all), ("line counts", self._count_all))
        self._threads = tuple(threading.Thread(target=run, name=name, daemon=True) for name, run in runs)
        for thread in self._threads:
            thread.start()
        if not self._begun.wait(BEGIN_S) or self._subscription is None:
            self.stop(0.0)
            raise self._why_not or _not_started("its process did not begin")

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
        self._until_s = time.monotonic() + timeout_s
        if self._subscription is not None:
            self._subscription.close()
        self._processes.stop(self._until_s, self._lot)
        self.wait(timeout_s + HURRY_S)
        self._over = True
        self._processes.close()
        done = self.wait(HURRY_S) and (self._done or not self._threads)
        self._phase = Phase.STOPPED
        self._processes.give_back()
        return done

    def keep_rest(self, timeout_s: float = math.inf) -> None:
        """Keep what still waited for the disk when the line was stopped, as far as there is time. Any number of times.

        Raises:
            WorldError: the store cannot take it; it waits on.
        """
        until_s = time.monotonic() + timeout_s
        while self._counting.retry() and time.monotonic() < until_s:
            pass
        left = self._counting.sink_state
        if left.waiting and left.problem is not None:
            raise left.problem

    def wait(self, timeout_s: float) -> bool:
        """Wait until the line has ended by itself (its recordings are over); return whether it has."""
        until_s = time.monotonic() + timeout_s
        for thread in self._threads:
            thread.join(max(until_s - time.monotonic(), 0.0))
        return not any(thread.is_alive() for thread in self._threads)

    @property
    def state(self) -> LiveState:
        """How the line is: what is in view as of the last observation, everything else as of now."""
        drawn, subscription, sink = self._drawn, self._subscription, self._counting.sink_state
        return replace(
            drawn,
            phase=self._phase,
            lot=self._lot,
            counted=self._counting.counted,
            passed=self._counting.passed,
            last=self._counting.last,
            health=self._healths(),
            backlog=drawn.backlog + (subscription.waiting if subscription else 0),
            waiting_fruit=drawn.waiting_fruit + self._out.qsize() + sink.waiting,
            skipped=drawn.skipped + self._skipped,
            dropped=subscription.dropped if subscription else {},
            sink=sink,
            warnings=self.warnings,
        )

    @property
    def previews(self) -> dict[str, Preview]:
        """The newest picture of each sensor, by its id in the feed."""
        return self._gallery.previews

    @property
    def warnings(self) -> tuple[LiveWarning, ...]:
        """What a person should know."""
        return (*self._drawn.warnings, *self._counting.warnings, *self._warnings.all())

    @property
    def pid(self) -> int | None:
        """Of the line's process; None before it was started."""
        return self._processes.pid

    def _start(self, between: Places) -> Start:
        """Return what a process begins with."""
        return Start(self._feed.infos, self._healths(), *self._recipe, between.memory.name, between.room)

    # The first thread: frames, in order of capture, to the line.

    def _give_all(self) -> None:
        self._begun.wait()
        subscription = self._subscription
        if subscription is None:
            return
        while not subscription.over and not self._over:
            arrival = subscription.take(TAKE_S)
            self._tell_healths()
            if arrival is not None:
                self._gallery.keep(arrival.frame)
                self._give(arrival)
        self._gave_all = True
        self._processes.no_more()

    def _tell_healths(self) -> None:
        """Say now and then how the sensors are."""
        now_s = time.monotonic()
        if now_s - self._told_s >= TAKE_S:
            self._told_s = now_s
            self._processes.tell(self._healths())

    def _healths(self) -> tuple[SensorHealth, ...]:
        return tuple(self._feed.health(sensor) for sensor in self._feed.sensors)

    def _give(self, arrival: Arrival) -> None:
        """Give a frame to the line, once there is one."""
        while not self._over:
            try:
                if self._processes.give(arrival, self._lot):
                    return
            except (TypeError, ValueError) as error:  # it has not the size that it says
                sensor = arrival.frame.sensor
                self._skipped += 1
                self._warnings.add("frame_skipped", f"A frame of sensor {sensor} could not be used: {error}", (sensor,))
                return
            time.sleep(GONE_S)

    # The second thread: what the line says.

    def _hear_all(self) -> None:
        try:
            for message in self._processes.heard(self._goes_on, self._say_begun_again):
                self._hear(message)
        finally:
            if not self._ended and self._until_s is None:
                text = "The line's process ended again and again; nothing is counted. End the lot and start it again."
                self._warnings.add("line_lost", text, ())
            self._over = True
            self._begun.set()
            self._out.put(None)

    def _goes_on(self) -> bool:
        """Whether another process is to go on where one ended: it ended unasked, and there was a line."""
        return not self._ended and self._until_s is None and self._subscription is not None

    def _say_begun_again(self, text: str) -> None:
        self._warnings.add("line_begun_again", text, ())

    def _hear(self, message: Any) -> None:  # noqa: ANN401 - one of the messages
        match message:
            case Drawn():
                self._drawn = message.state
            case Pictured():
                self._gallery.show(message.previews)
            case Out():
                self._out.put(message)
            case Shifted() if self._subscription is not None:
                self._subscription.shift(message.offsets_s)
            case Made():
                self._meet(message)
            case NotMade():
                self._why_not, self._ended = message.why, True
            case Ended():
                self._done, self._ended = message.done, True

    def _meet(self, made: Made) -> None:
        """Give a line that is there what it wants, and tell it what was said before."""
        if self._subscription is None:
            self._subscription = self._feed.subscribe(made.room, made.order)
            self._begun.set()
        if self._gave_all:
            self._processes.no_more()
        if self._until_s is not None:
            self._processes.stop(self._until_s, self._lot)

    # The third thread: fruit kept, counted.

    def _count_all(self) -> None:
        count_all(self._take, self._count, self._counting.retry, self._warnings.add)
        if self._phase is Phase.RUNNING:
            self._phase = Phase.ENDED

    def _take(self, timeout_s: float) -> Out | None:
        return self._out.get(timeout=timeout_s)

    def _count(self, out: Out) -> None:
        """Count a fruit; its number goes on from process to process."""
        self._counted += 1
        fruit = replace(out.finished.fruit, fruit=self._counted)
        self._counting.count(replace(out.finished, fruit=fruit), out.lot)


def _most_pixels(feed: Feed) -> int:
    """Return how many the largest picture has."""
    return max(info.intrinsics.width * info.intrinsics.height for info in feed.infos.values())


def _not_started(why: str) -> WorldError:
    return WorldError(
        "line_not_started",
        f"The line could not be started: {why}.",
        "Close other programs and try again.",
    )
