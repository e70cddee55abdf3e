"""What drivers say of their devices, in the operator's language; what is not known here is said as it is."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QCoreApplication

translate = QCoreApplication.translate


def fault_words() -> Mapping[str, tuple[str, str]]:
    """Return what is wrong with a device and what to do, by the code of its driver's error."""
    return {
        "no_libfreenect": (
            translate("Driver", "The library for Kinects is not installed."),
            translate("Driver", "In a terminal: sudo apt install libfreenect0.5. Then start this program again."),
        ),
        "no_libusb": (
            translate("Driver", "The library for USB is not installed."),
            translate("Driver", "In a terminal: sudo apt install libusb-1.0-0. Then start this program again."),
        ),
        "sdk_missing": (
            translate("Driver", "The library of its maker is not installed."),
            translate(
                "Driver", "The manual, “Which sensors”, tells how it is installed. Then start this program again."
            ),
        ),
        "sdk_broken": (
            translate("Driver", "The library of its maker cannot be loaded."),
            translate("Driver", "Install it again; the manual, “Which sensors”, tells how."),
        ),
        "sensor_gone": (
            translate("Driver", "It is not plugged in."),
            translate("Driver", "Check its USB cable and its power supply; it starts by itself when it returns."),
        ),
        "sensor_not_allowed": (
            translate("Driver", "The system does not let you use it."),
            translate("Driver", "Press “Check sensors…” and there “Let me use them…”."),
        ),
        "sensor_busy": (
            translate("Driver", "Another program uses it."),
            translate("Driver", "Close that program; “Check sensors…” tells which it is."),
        ),
        "sensor_held": (
            translate(
                "Driver", "The system uses it as a webcam (its driver is gspca_kinect) and does not let go of it."
            ),
            translate(
                "Driver",
                "In a terminal: sudo modprobe -r gspca_kinect. To keep that driver away for good, write the line "
                "“blacklist gspca_kinect” into /etc/modprobe.d/kinect.conf.",
            ),
        ),
        "sensor_twice": (
            translate("Driver", "Another Kinect has the same serial: they cannot be told apart."),
            translate("Driver", "Leave only one of them plugged in."),
        ),
        "sensor_not_obeyed": (
            translate("Driver", "It does not do what it is told."),
            translate(
                "Driver", "Unplug its USB cable and its power supply, wait five seconds, and plug both in again."
            ),
        ),
        "sensor_hangs": (
            translate("Driver", "It does not answer."),
            translate(
                "Driver", "Unplug its USB cable and its power supply, wait five seconds, and plug both in again."
            ),
        ),
        "usb_full": (
            translate("Driver", "No room is left for its pictures on its USB controller."),
            translate("Driver", "Plug it into a socket of another USB controller: each carries one Kinect."),
        ),
    }


def _limits() -> Mapping[str, str]:
    return {
        "Its LED, tilt and accelerometer answer only with": translate(
            "Driver",
            "Its LED, tilt and accelerometer answer only with a firmware of Microsoft's that cannot be handed on: a "
            "bump is seen in the pictures only.",
        ),
        "It is known by the serial of its microphone": translate(
            "Driver", "It is known by the serial of its microphone, since its camera has none."
        ),
        "Its near mode is not used": translate("Driver", "Its near mode is not used."),
        "On a USB 2 port it gives": translate(
            "Driver",
            "On a USB 2 port it gives fewer and smaller pictures: plug it into a USB 3 port with a USB 3 cable.",
        ),
        "This user may not open it": translate("Driver", "The system does not let you use it."),
        "It does not answer": translate("Driver", "It does not answer."),
        "It cannot be told apart": translate(
            "Driver", "It cannot be told apart from another one that has the same serial: plug in only one of them."
        ),
    }


def limit_words(limit: str) -> str:
    """Return what a model cannot do, in the operator's language."""
    return next((words for beginning, words in _limits().items() if limit.startswith(beginning)), limit)
