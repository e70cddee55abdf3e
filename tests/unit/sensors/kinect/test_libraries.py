"""The libraries as they are installed here, with whatever is plugged in: mostly nothing."""

from __future__ import annotations

import ctypes
import subprocess
import sys

import pytest

from fruitgui.errors import WorldError
from fruitgui.sensors.drivers import known_drivers
from fruitgui.sensors.kinect import library
from fruitgui.sensors.kinect.driver import KinectDriver

ALONE = """
import sys
from fruitgui.sensors.drivers import known_drivers
(driver,) = [one for one in known_drivers() if one.make == "kinect"]
maps = open("/proc/self/maps").read()
assert "libfreenect" not in maps and "libusb" not in maps, "a library was loaded before anything was asked"
driver.devices()
assert driver.problem() is None
heavy = {"open3d", "pyrealsense2", "pyorbbecsdk", "depthai", "PySide6", "scipy", "cv2"} & set(sys.modules)
assert not heavy, heavy
"""


def test_records_of_the_libraries_have_their_sizes() -> None:
    # sizeof in C, on 64 bits
    assert ctypes.sizeof(library.FrameMode) == 24
    assert ctypes.sizeof(library.RegistrationInfo) == 176
    assert ctypes.sizeof(library.DeviceDescriptor) == 18


def test_the_driver_is_known_and_its_libraries_are_there() -> None:
    (driver,) = [one for one in known_drivers() if one.make == "kinect"]
    assert driver.problem() is None


def test_a_kinect_that_is_nowhere_is_said_to_be_away() -> None:
    sensor = KinectDriver().sensor("of nobody")
    for _ in range(2):
        with pytest.raises(WorldError) as away:
            sensor.open()
        assert away.value.code in ("sensor_gone", "sensor_not_allowed", "no_usb")
        assert away.value.remedy
    sensor.close()


def test_looking_for_kinects_loads_nothing_else() -> None:
    done = subprocess.run([sys.executable, "-c", ALONE], capture_output=True, text=True, check=False, timeout=120)
    assert done.returncode == 0, done.stderr


def test_a_missing_library_is_said_with_its_package() -> None:
    with pytest.raises(WorldError) as missing:
        library.libfreenect("libfreenect-of-tomorrow.so")
    assert missing.value.code == "no_libfreenect"
    assert "libfreenect0.5" in missing.value.remedy


def test_a_library_that_lacks_functions_is_not_taken_for_it() -> None:
    with pytest.raises(WorldError):
        library.libfreenect("libc.so.6")
