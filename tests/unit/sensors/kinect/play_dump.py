"""`python -m tests.unit.sensors.kinect.play_dump HOW`: plays FAKENECT_PATH through the product, prints what came.

HOW is `raw` for each picture of the device, or `frames` for a sensor's frames.
"""

from __future__ import annotations

import ctypes
import hashlib
import json
import platform
import sys
from typing import Any

import numpy as np

from fruitgui.errors import WorldError
from fruitgui.sensors.kinect.bus import Camera
from fruitgui.sensors.kinect.cameras import cameras_of
from fruitgui.sensors.kinect.device import Device, Hear, Picture
from fruitgui.sensors.kinect.factory import Factory
from fruitgui.sensors.kinect.library import libfreenect
from fruitgui.sensors.kinect.models import KINECT_1414
from fruitgui.sensors.kinect.packets import Stream
from fruitgui.sensors.kinect.sensor import KinectSensor
from fruitgui.sensors.kinect.session import LeftBehind
from tests.emulated_usb.dumps import LIBRARY


class NoBus:
    """A bus with one camera, and nothing behind it."""

    context = ctypes.c_void_p()

    def open(self) -> None:
        pass

    def close(self) -> None:
        pass

    def cameras(self) -> list[Camera]:
        return [Camera(0, "dump", KINECT_1414, 1, 267)]


def device(hear: Hear) -> Device:
    return Device(libfreenect(LIBRARY.format(platform.machine())), NoBus(), "dump", hear)


def raw() -> list[Any]:
    came: list[Any] = []

    def hear(stream: Stream, picture: Picture) -> None:
        came.append([stream, picture.stamp, hashlib.blake2b(picture.pixels.tobytes()).hexdigest(), picture.whole])

    player = device(hear)
    player.open()
    for stream in Stream:
        player.switch(stream, on=True)
    while not player.gone:  # it has no end but that nothing comes any more
        player.pump(0.01)
    player.close()
    return came


def frames() -> list[Any]:
    came: list[Any] = []
    usual = cameras_of(Factory()).registration  # made before the files begin to play
    usual.apply(np.full((480, 640), 1000, np.uint16))
    sensor = KinectSensor("dump", device, LeftBehind())
    sensor.open()
    sensor.start()
    while True:
        try:
            frame = sensor.read(20.0)
        except WorldError:
            break
        digest = hashlib.blake2b(frame.color.tobytes()).hexdigest()
        came.append([frame.sequence, frame.time_s, int(frame.depth_mm.max()), digest, frame.damaged])
    sensor.stop()
    sensor.close()
    return came


if __name__ == "__main__":
    sys.stderr.write(json.dumps({"raw": raw, "frames": frames}[sys.argv[1]]()))  # the library itself writes to stdout
