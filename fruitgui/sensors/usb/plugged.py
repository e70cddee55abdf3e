"""Whether a make of devices is plugged in at all, before its library is loaded for it."""

from __future__ import annotations

import sys

from fruitgui.sensors.usb.known import known_device
from fruitgui.sensors.usb.machine import Machine
from fruitgui.sensors.usb.tree import read_tree


def is_plugged(make: str, machine: Machine | None = None) -> bool:
    """Tell whether the USB shows a device of a make; where this system cannot tell, it may well be."""
    if machine is None and not sys.platform.startswith("linux"):
        return True
    devices = read_tree(machine or Machine()).devices
    return any(known.make == make for known in map(known_device, devices) if known is not None)
