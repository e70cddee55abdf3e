"""Projectors of Kinects measured through the real libfreenect: over an emulated bus whose light settles and blinds."""

from __future__ import annotations

import threading
import time
from datetime import UTC, datetime
from pathlib import Path

import numpy as np

from fruitgui.calibration.projectors.interference import Harm
from fruitgui.calibration.projectors.settling import Settled
from fruitgui.frame import U16
from fruitgui.sensors.feed import Feed
from fruitgui.sensors.kinect.clock import FRAME_TICKS
from fruitgui.sensors.kinect.driver import KinectDriver
from fruitgui.station import projector_job
from tests.emulated_usb import pictures
from tests.emulated_usb.emulation import Emulation, Kinect
from tests.emulated_usb.outside import inside
from tests.unit.sensors.kinect.test_turns_on_emulated_usb import clashes

NO_READING = 2047
SETTLES_S = 0.25
ALONE, BLINDED = 0.05, 0.20


class SettlingLight:
    """Pushes pictures of Kinects whose depth fills up once their projector is on, and thins out beside another's."""

    def __init__(self, usb: Emulation, count: int) -> None:
        self._usb = usb
        self._count = count
        self._stop = threading.Event()
        self._threads = [threading.Thread(target=self._run, args=(number,)) for number in range(count)]

    def __enter__(self) -> None:
        for thread in self._threads:
            thread.start()

    def __exit__(self, *_: object) -> None:
        self._stop.set()
        for thread in self._threads:
            thread.join()

    def _run(self, number: int) -> None:
        grey, order = pictures.grey(100), np.random.default_rng(number).permutation(40 * 30)
        ticks, on_s = 0, 0.0
        while not self._stop.wait(1 / 30):
            ticks += FRAME_TICKS
            on_s = (on_s or time.monotonic()) if self._usb.shines(number) else 0.0
            others = any(self._usb.shines(other) for other in range(self._count) if other != number)
            left = max(1.0 - (time.monotonic() - on_s) / SETTLES_S, 0.0) if on_s else 1.0
            self._usb.push_video(number, grey, ticks, 0)
            self._usb.push_depth(
                number, _with_holes((BLINDED if others else ALONE) + 0.6 * left, order), ticks + 60_000, 0
            )


def _with_holes(share: float, order: np.ndarray[tuple[int], np.dtype[np.int64]]) -> U16:
    """Return raw depth without readings in a share of its squares of 16 by 16: single ones close when registered."""
    missing = np.zeros(40 * 30, dtype=bool)
    missing[order[: round(share * len(order))]] = True
    holes = missing.reshape(30, 40).repeat(16, axis=0).repeat(16, axis=1)
    return np.where(holes, np.uint16(NO_READING), pictures.level(700))


@inside
def test_two_kinects_lights_are_measured_and_shine_together_only_while_they_are_tried(
    usb: Emulation,
    tmp_path: Path,  # noqa: ARG001
) -> None:
    projector_job.TRIALS, projector_job.VIEWS, projector_job.TOGETHER = 3, 24, 8  # type: ignore[misc]
    usb.plug_in(Kinect("A1"), Kinect("B2"))
    driver = KinectDriver()
    feed = Feed([driver.sensor(serial) for serial in ("A1", "B2")])
    with SettlingLight(usb, 2):
        feed.start()
        try:
            told: list[float] = []
            tried = projector_job.try_projectors(feed, datetime.now(UTC), lambda share, _doing: told.append(share))
            clashed = clashes(usb.log())
            began_s = time.monotonic()
            queue = feed.subscribe(100)
            while not all(feed.health(one).rate_hz for one in feed.sensors):
                assert time.monotonic() - began_s < 60.0
                queue.take(0.1)
        finally:
            feed.stop()
    for sensor, found in tried.alone.items():
        assert isinstance(found, Settled), (sensor, found)
        # Pictures wait in the bus and in the library: light is told late, by some pictures, never early.
        assert 0.8 * SETTLES_S < found.settle_s < SETTLES_S + 0.35
        # Registered depth has a margin without readings, and small holes close.
        assert found.steady.holes < ALONE + 0.2
    (pair,) = tried.pairs
    assert pair.seen is not None
    assert all(one.harm is Harm.MUCH for one in pair.seen)
    assert all(0.08 < one.holes_together - one.holes_alone < BLINDED for one in pair.seen)
    assert set(tried.projectors.settlings) == {"A1", "B2"}
    assert clashed <= 2  # the one time that both were tried together
    assert clashes(usb.log()) == clashed
