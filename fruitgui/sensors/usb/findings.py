"""What the USB tree alone tells: sensors that nobody may use, that have no power, or that do not fit."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from fruitgui.sensors.usb.holders import Holders, read_holders
from fruitgui.sensors.usb.known import KnownDevice, Part, known_device
from fruitgui.sensors.usb.machine import Machine, number_of
from fruitgui.sensors.usb.problems import Problem, problem
from fruitgui.sensors.usb.tree import HIGH_SPEED_MBPS, UsbDevice, UsbTree, read_tree
from fruitgui.sensors.usb.udev import rules_are_installed

USBFS_MB: Mapping[str, float] = {"kinect": 1.0}
"""What a running sensor holds of the system's memory for USB: libfreenect keeps 16 × 16 packets of each stream."""

USBFS_OTHER_MB = 4.0
WEBCAM_DRIVERS = ("gspca_kinect",)


@dataclass(frozen=True, slots=True)
class SeenSensor:
    """A depth sensor as the USB tree shows it.

    Attributes:
        device: it. known: which it is. problems: what is in its way.
        serials: its own and those of its other parts: some Kinects have one in their microphone only.
    """

    device: UsbDevice
    known: KnownDevice
    problems: tuple[Problem, ...] = ()
    serials: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class UsbView:
    """The USB of a system, looked over.

    Attributes:
        tree: all of it. sensors: the depth sensors on it.
        problems: of the system itself, and of sensors that show no camera.
    """

    tree: UsbTree
    sensors: tuple[SeenSensor, ...]
    problems: tuple[Problem, ...]

    @property
    def shown(self) -> bool:
        """Whether the system shows any USB."""
        return bool(self.tree.buses or self.tree.devices)


def look_over(machine: Machine, own_pid: int) -> UsbView:
    """Look a system's USB over; what cannot be read is missing, never an error."""
    tree = read_tree(machine)
    holders = read_holders(machine, own_pid)
    denied = "no_access_yet" if rules_are_installed(machine) else "no_access"
    known = [(device, which) for device in tree.devices if (which := known_device(device)) is not None]
    seen = [
        SeenSensor(device, which, tuple(_of_device(machine, device, which, holders, denied)), _serials(tree, device))
        for device, which in known
        if which.part is Part.SENSOR
    ]
    problems = [*_without_power(tree, known), *_memory(machine, seen)]
    return UsbView(tree, tuple(seen), tuple(problems))


def _of_device(machine: Machine, device: UsbDevice, known: KnownDevice, holders: Holders, denied: str) -> list[Problem]:
    found = []
    node = machine.node(device.bus, device.address)
    if not node.exists():
        found.append(problem("no_node", node=str(node)))
    elif not machine.usable(node):
        found.append(problem(denied))
    held = holders.get((device.bus, device.address), ())
    if held:
        found.append(problem("busy", programs=", ".join(f"{one.program} (process {one.pid})" for one in held)))
    for driver in device.drivers:
        if driver in WEBCAM_DRIVERS:
            found.append(problem("kernel_driver", driver=driver))
    if 0.0 < device.speed_mbps < known.needs_mbps:
        usb = "2" if known.needs_mbps <= HIGH_SPEED_MBPS else "3"
        speed, needed = f"{device.speed_mbps:g}", f"{known.needs_mbps:g}"
        found.append(problem("slow_port", speed=speed, needed=needed, usb=usb))
    return found


def _serials(tree: UsbTree, device: UsbDevice) -> tuple[str, ...]:
    parts = (one for one in tree.beside(device) if known_device(one) is not None)
    return tuple(one.serial for one in (device, *parts) if one.serial.strip("0"))


def _without_power(tree: UsbTree, known: Sequence[tuple[UsbDevice, KnownDevice]]) -> list[Problem]:
    """Return a problem for each motor of a Kinect that has no camera beside it: the camera lives of the adapter."""
    cameras = {one.path for one, which in known if which.part is Part.SENSOR}
    motors = [one for one, which in known if which.part is Part.MOTOR]
    return [problem("no_power") for one in motors if not any(beside.path in cameras for beside in tree.beside(one))]


def _memory(machine: Machine, seen: Sequence[SeenSensor]) -> list[Problem]:
    have_mb = number_of(machine.usbfs_memory)
    need_mb = math.ceil(sum(USBFS_MB.get(one.known.make, USBFS_OTHER_MB) for one in seen))
    if not have_mb or need_mb <= have_mb:  # 0 is without limit
        return []
    return [problem("usbfs_memory", have=str(have_mb), need=str(need_mb), want=str(max(4 * need_mb, 64)))]
