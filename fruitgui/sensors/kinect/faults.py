"""What can be wrong with a Kinect, in words, each with its remedy."""

from __future__ import annotations

from collections.abc import Sequence

from fruitgui.errors import WorldError
from fruitgui.sensors.kinect.bus import Camera, Unknown

_ACCESS, _BUSY, _GONE = ("ACCESS", ": -3"), ("BUSY", ": -6"), ("NO_DEVICE", ": -4")
_HELD = "Failed to detach"
_AWAY = ("transfer failed (-4)", "returned -4")
"""What the library says of an order to a device that was unplugged meanwhile."""


def not_there(serial: str, cameras: Sequence[Camera]) -> WorldError:
    """No Kinect of this serial can be opened."""
    if any(one.unknown is Unknown.CLOSED for one in cameras):
        return not_allowed(serial)
    if any(one.unknown is Unknown.MUTE for one in cameras):
        return mute(serial)
    if sum(one.serial == serial for one in cameras) > 1:
        return WorldError(
            "sensor_twice",
            f"Two Kinects have the serial {serial}: they cannot be told apart.",
            "Leave only one of them plugged in.",
        )
    return WorldError(
        "sensor_gone",
        f"The Kinect {serial} is not plugged in.",
        "Check its USB cable and its power supply; it starts by itself when it returns.",
    )


def not_allowed(serial: str) -> WorldError:
    """A Kinect is there but may not be opened."""
    return WorldError(
        "sensor_not_allowed",
        f"A Kinect is plugged in, but this user may not open it, so {serial} was not found.",
        "Install the USB rules (fruitgui sensors --install-udev-rules), then unplug it and plug it in again.",
    )


def mute(serial: str) -> WorldError:
    """A Kinect is there but does not say which."""
    return WorldError(
        "sensor_hangs",
        f"A Kinect is plugged in that does not answer, so {serial} was not found.",
        "Unplug its USB cable and its power supply, wait five seconds, and plug both in again.",
    )


def not_opened(serial: str, errors: Sequence[str]) -> WorldError:
    """The library could not open a Kinect that is there."""
    last = "; ".join(errors)
    if _HELD in last:
        return held_by_system(serial)
    if any(word in last for word in _BUSY):
        return WorldError(
            "sensor_busy",
            f"The Kinect {serial} is used by another program.",
            "Close the other program; fruitgui sensors tells which it is.",
        )
    if any(word in last for word in _ACCESS):
        return not_allowed(serial)
    if any(word in last for word in _GONE):
        return not_there(serial, ())
    return not_obeyed(serial, errors)


def held_by_system(serial: str) -> WorldError:
    """The kernel's webcam driver does not let go of a Kinect."""
    return WorldError(
        "sensor_held",
        f"The system uses the Kinect {serial} as a webcam (its driver is gspca_kinect) and does not let go of it.",
        "In a terminal: sudo modprobe -r gspca_kinect. To keep that driver away for good, write the line "
        "“blacklist gspca_kinect” into /etc/modprobe.d/kinect.conf.",
    )


def not_obeyed(serial: str, errors: Sequence[str]) -> WorldError:
    """A Kinect answers wrongly or not at all."""
    if any(word in one for one in errors for word in _AWAY):
        return not_there(serial, ())
    says = f" ({errors[0][:120]})" if errors else ""
    return WorldError(
        "sensor_not_obeyed",
        f"The Kinect {serial} does not do what it is told{says}.",
        "Unplug its USB cable and its power supply, wait five seconds, and plug both in again.",
    )


def usb_full(serial: str) -> WorldError:
    """No room is left on the USB controller."""
    return WorldError(
        "usb_full",
        f"The USB controller of the Kinect {serial} has no room left for its pictures.",
        "Plug it into a socket of another USB controller: each carries colour and depth of one Kinect.",
    )


def hangs(serial: str) -> WorldError:
    """A call into the library does not come back."""
    return WorldError(
        "sensor_hangs",
        f"The Kinect {serial} does not answer.",
        "Unplug its USB cable and its power supply, wait five seconds, and plug both in again.",
    )
