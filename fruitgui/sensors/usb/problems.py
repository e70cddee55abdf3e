"""What can be wrong with sensors and their USB, each with what to do about it, in plain words."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from fruitgui.errors import FruitguiError


@dataclass(frozen=True, slots=True)
class Problem:
    """One thing that is wrong.

    Attributes:
        code: a stable word.
        what: is wrong, one sentence. remedy: what to do, one or two.
        values: that stand in the sentences, by name, for whoever says them in another language.
    """

    code: str
    what: str
    remedy: str
    values: Mapping[str, str] = field(default_factory=dict)


WORDS: Mapping[str, tuple[str, str]] = {
    # of the system
    "nothing_connected": (
        "No depth sensor was found on this computer.",
        "Plug one in straight at the computer, switch its power supply on, and check again after ten seconds.",
    ),
    "no_usb": (
        "No depth sensor was found: this system shows no USB at all.",
        "In a virtual machine or a container, hand the computer's USB devices on to it. On a computer, look in its "
        "BIOS whether USB is switched off.",
    ),
    "bus_full": (
        "{sensors} share one USB controller ({controller}); it has room for one Kinect with colour and depth.",
        "Controller {free} has room: try one sensor in other sockets until this check shows it there.",
    ),
    "buses_full": (
        "{sensors} share one USB controller ({controller}); it has room for one Kinect with colour and depth.",
        "No other controller with room is known here: try other sockets, or add a USB card for each further Kinect.",
    ),
    "bus_tight": (
        "{sensors} share one USB controller ({controller}), which is sure to carry one Kinect with colour and depth; "
        "they ran without loss now.",
        "Watch whether it stays so. If not, give one of them another controller.",
    ),
    "usbfs_memory": (
        "All programs together may hold {have} MB for USB, and these sensors need {need} MB.",
        "As the administrator: echo {want} > /sys/module/usbcore/parameters/usbfs_memory_mb; to keep it, add "
        "usbcore.usbfs_memory_mb={want} to the kernel's command line.",
    ),
    "driver_hangs": (
        "The driver for {make} does not answer.",
        "Unplug these sensors, plug them in again, and check again. If it stays so, restart the computer.",
    ),
    "driver_failed": (
        "The driver for {make} failed: {why}.",
        "Unplug these sensors and plug them in again. If it stays so, install the program again.",
    ),
    # of one sensor
    "no_power": (
        "A Kinect shows its motor but no camera: it has no power.",
        "Plug in its power supply, at the wall and at the cable. USB alone does not feed a Kinect.",
    ),
    "unsupported": (
        "There is no driver for {model} in this version.",
        "Use a sensor that is supported, or record it with ROS 2 and open the recording.",
    ),
    "no_access": (
        "The system does not let you use it.",
        "Install the rules that do: fruitgui sensors --install-udev-rules. Then unplug it and plug it in again.",
    ),
    "no_access_yet": (
        "The system does not let you use it, although the rules are installed.",
        "Unplug it and plug it in again. If it stays so, restart the computer.",
    ),
    "no_node": (
        "The system knows it, but shows no file to use it through ({node}).",
        "In a container, hand /dev/bus/usb on to it. Else unplug it and plug it in again.",
    ),
    "busy": (
        "Another program has it open: {programs}.",
        "Close that program, then check again.",
    ),
    "kernel_driver": (
        "The system uses it as a webcam ({driver}).",
        "It is taken over when it runs. If that fails: sudo modprobe -r {driver}",
    ),
    "slow_port": (
        "It runs at {speed} Mbit/s and needs {needed} Mbit/s to give all its pictures.",
        "Use the cable that came with it, straight at the computer, in a socket of USB {usb}. Those of USB 3 are "
        "mostly blue.",
    ),
    "not_found": (
        "It is plugged in, but its driver does not find it.",
        "Unplug it and plug it in again, with its power supply.",
    ),
    "no_serial": (
        "It has the same serial as another sensor, or none: they cannot be told apart.",
        "Use one of them only, or one of another model.",
    ),
    "no_serial_alone": (
        "It has no serial: it can be run only as long as no other of its make is plugged in.",
        "Plug in only this one. Where connecting does not list it, the line needs one that has a serial.",
    ),
    "closed": (
        "It cannot be opened: the system does not let you, or another sensor has its serial.",
        "Install the rules that do: fruitgui sensors --install-udev-rules. Of two with one serial, plug in only one.",
    ),
    "hangs": (
        "Its driver hangs.",
        "Unplug it and plug it in again, then check again.",
    ),
    "silent": (
        "It gave no picture in {seconds} s.",
        "Check its power supply and cable; give it a socket of its own, not on a hub.",
    ),
    "fell_silent": (
        "It stopped giving pictures while it was watched.",
        "Check that its plugs sit firmly, and its power supply.",
    ),
    "slow": (
        "It gives {rate} of {nominal} pictures a second.",
        "Give it a USB controller of its own, and close other programs.",
    ),
    "loses": (
        "It lost {lost} of {all} pictures, though this computer had time to take them.",
        "Use a shorter cable without a hub, and a USB controller of its own.",
    ),
    "loses_busy": (
        "It lost {lost} of {all} pictures; this computer was too busy to take some of them: {late} ms late at worst, "
        "and a sensor waits some {holds} ms.",
        "Close other programs and check again. If pictures are lost then too, and this computer is said to have time, "
        "it is the cable or the USB controller.",
    ),
}
"""What is wrong, and what to do, by code."""


def problem(code: str, **values: str) -> Problem:
    """Return a problem in words. Raises `KeyError` for a code that has none, or a value that is missing."""
    what, remedy = WORDS[code]
    return Problem(code, what.format(**values), remedy.format(**values), values)


def problem_of(error: FruitguiError) -> Problem:
    """Return an error, of a driver for example, as a problem."""
    return Problem(error.code, error.what, error.remedy, {name: str(value) for name, value in error.values.items()})
