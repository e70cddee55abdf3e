"""Lets emulated Kinects stream by themselves, with faults at their times or on command."""

from __future__ import annotations

import threading
import time
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from types import TracebackType
from typing import Self

import numpy as np

from fruitgui.frame import U8, U16
from fruitgui.sensors.kinect.clock import FRAME_TICKS, TICKS_PER_S
from tests.emulated_usb import pictures
from tests.emulated_usb.emulation import Emulation, Garbage, Hang

Scene = Callable[[int, float], tuple[U16, U8]]
"""(Kinect, seconds since the beginning) → raw depth and the colour camera's raw pixels, (480, 640) each."""

RATE_HZ = TICKS_PER_S / FRAME_TICKS
_COLOR_LATER_TICKS = 60_000
_LOOP = 60


@dataclass(frozen=True, slots=True)
class Fault:
    """Something that happens.

    Attributes:
        at_s: when, in device time since the beginning.
        what: `unplug`, `plug_in`, `silence` (nothing is sent for `value` seconds), `lose_every` (`value` packets, 0
            ends it), `lose` (`value` packets of the next picture), `garbage` (kind `value`, 0 ends it), `stall`,
            `hang`, `busy`, `no_bandwidth`, `denied` (`value` 1, 0 ends it), `clock_jump` (by `value` seconds).
        kinect: its number, from 0.
        value: see above.
    """

    at_s: float
    what: str
    kinect: int = 0
    value: float = 1.0


def moving_belt() -> Scene:
    """Return a scene that repeats every two seconds: pictures are made once."""
    loop = [pictures.belt(count) for count in range(_LOOP)]
    return lambda _kinect, time_s: loop[round(time_s * RATE_HZ) % _LOOP]


class Player:
    """Pushes the pictures of all Kinects that are plugged in at their pace, a thread for each, from `start` to `stop`.

    Its time is the process's monotonic clock, also where a test lets that run faster.

    Args:
        usb: the bus, with Kinects plugged in.
        scene: what they see.
        faults: what happens, in any order; more by `do`.
        wait_ms: so long a picture waits for the host to take it; at 0 it is lost at once, as on a real bus.
        seed: of the device clocks' beginnings and drifts.
    """

    def __init__(
        self,
        usb: Emulation,
        scene: Scene | None = None,
        faults: Iterable[Fault] = (),
        wait_ms: int = 0,
        seed: int = 0,
    ) -> None:
        self._usb = usb
        self._scene = scene or moving_belt()
        self._faults = sorted(faults, key=lambda fault: fault.at_s)
        self._wait_ms = wait_ms
        rng = np.random.default_rng(seed)
        self._beginnings = [int(rng.integers(2**32)) for _ in usb.kinects]
        self._drifts = [float(rng.uniform(-50e-6, 50e-6)) for _ in usb.kinects]
        self._silent_until_s = [0.0 for _ in usb.kinects]
        self._stop = threading.Event()
        self._threads: list[threading.Thread] = []
        self._began_s = 0.0
        self.sent: Counter[int] = Counter()
        self.damaged: Counter[int] = Counter()
        self.late_s = [0.0 for _ in usb.kinects]

    def __enter__(self) -> Self:
        self.start()
        return self

    def __exit__(
        self, _kind: type[BaseException] | None, _error: BaseException | None, _trace: TracebackType | None
    ) -> None:
        self.stop()

    def start(self) -> None:
        """Begin."""
        self._began_s = time.monotonic()
        tasks = [("faults", self._happen, ())]
        tasks += [(f"emulated kinect {number}", self._stream, (number,)) for number in range(len(self._beginnings))]
        self._threads = [threading.Thread(target=run, name=name, args=given, daemon=True) for name, run, given in tasks]
        for thread in self._threads:
            thread.start()

    def stop(self) -> None:
        """End."""
        self._stop.set()
        for thread in self._threads:
            thread.join()

    @property
    def now_s(self) -> float:
        """Device time since the beginning."""
        return time.monotonic() - self._began_s

    @property
    def began_s(self) -> float:
        """When it began, by the host's monotonic clock."""
        return self._began_s

    def do(self, fault: Fault) -> None:
        """Let something happen now."""
        usb, number, value = self._usb, fault.kinect, fault.value
        deeds: dict[str, Callable[[], object]] = {
            "unplug": lambda: usb.plug(number, on=False),
            "plug_in": lambda: usb.plug(number, on=True),
            "silence": lambda: self._silence(number, value),
            "lose_every": lambda: usb.lose_every(number, int(value)),
            "lose": lambda: usb.lose(number, 50, int(value)),
            "garbage": lambda: usb.garbage(number, Garbage(int(value))),
            "stall": lambda: usb.stall(number, on=bool(value)),
            "hang": lambda: usb.hang(number, Hang(int(value))),
            "busy": lambda: usb.busy(number, on=bool(value)),
            "denied": lambda: usb.denied(number, on=bool(value)),
            "no_bandwidth": lambda: usb.no_bandwidth(number, on=bool(value)),
            "clock_jump": lambda: self._jump(number, value),
        }
        deeds[fault.what]()

    def _silence(self, number: int, seconds: float) -> None:
        self._silent_until_s[number] = self.now_s + seconds

    def _jump(self, number: int, seconds: float) -> None:
        self._beginnings[number] += round(seconds * TICKS_PER_S)

    def _happen(self) -> None:
        for fault in self._faults:
            if self._stop.wait(max(fault.at_s - self.now_s, 0.0)):
                return
            self.do(fault)

    def _stream(self, number: int) -> None:
        count = 0
        while not self._stop.wait(max(count / RATE_HZ - self.now_s, 0.0)):
            time_s = count / RATE_HZ
            self.late_s[number] = self.now_s - time_s
            if time_s >= self._silent_until_s[number]:
                self._send(number, time_s)
            # who is late does not hurry: what was not sent in time is not sent
            count = max(count + 1, int(self.now_s * RATE_HZ))

    def _send(self, number: int, time_s: float) -> None:
        raw, bayer = self._scene(number, time_s)
        ticks = self._beginnings[number] + round(time_s * TICKS_PER_S * (1.0 + self._drifts[number]))
        lost = self._usb.push_depth(number, raw, ticks, self._wait_ms)
        lost_color = self._usb.push_video(number, bayer, ticks + _COLOR_LATER_TICKS, self._wait_ms)
        if lost >= 0 and lost_color >= 0:
            self.sent[number] += 1
            self.damaged[number] += lost + lost_color > 0
