"""The USB tree: buses, the controllers that carry them, and the devices on their ports, read from sysfs."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from fruitgui.sensors.usb.machine import Machine, number_of, text_of

HIGH_SPEED_MBPS, SUPER_SPEED_MBPS = 480.0, 5000.0
"""USB 2 and USB 3, megabits a second."""

LONGEST_TEXT = 128
_DEVICE = re.compile(r"(\d{1,4})-(\d{1,3}(?:\.\d{1,3})*)", re.ASCII)
_ROOT = re.compile(r"usb(\d{1,4})", re.ASCII)


@dataclass(frozen=True, slots=True)
class UsbDevice:
    """One device that is plugged in.

    Attributes:
        bus, address: by which programs open it.
        ports: from the bus on, for example (1, 4).
        vendor, product, release: the numbers that it gives itself; `release` is bcdDevice, 0 where unknown.
        maker, name, serial: as it says; empty where it does not.
        speed_mbps: at which it runs, megabits a second; 0 where unknown.
        usb: the version of USB that it follows, for example 3.2; 0 where unknown.
        drivers: of the kernel, that hold its interfaces.
    """

    bus: int
    address: int
    ports: tuple[int, ...]
    vendor: int
    product: int
    release: int = 0
    maker: str = ""
    name: str = ""
    serial: str = ""
    speed_mbps: float = 0.0
    usb: float = 0.0
    drivers: tuple[str, ...] = ()

    @property
    def path(self) -> str:
        """The kernel's name of where it hangs, for example 1-1.4."""
        return f"{self.bus}-{'.'.join(str(port) for port in self.ports)}"


@dataclass(frozen=True, slots=True)
class UsbBus:
    """One bus, which is one end of a controller: a USB 3 controller has a bus for USB 2 and one for USB 3.

    Attributes:
        number: of the bus.
        controller: the address of the chip, for example 0000:00:14.0.
        driver: the kernel's of the controller, for example xhci_hcd; empty where unknown.
        speed_mbps: of its ports; 0 where unknown.
    """

    number: int
    controller: str
    driver: str = ""
    speed_mbps: float = 0.0


@dataclass(frozen=True, slots=True)
class UsbTree:
    """All of it at one moment.

    Attributes:
        buses: by number. devices: hubs too, in order of bus and ports.
    """

    buses: Mapping[int, UsbBus]
    devices: tuple[UsbDevice, ...]

    def controller(self, bus: int | None) -> str | None:
        """Return the controller that carries a bus; None where it is not known."""
        found = None if bus is None else self.buses.get(bus)
        return None if found is None else found.controller

    def beside(self, device: UsbDevice) -> tuple[UsbDevice, ...]:
        """Return the other devices on the same hub."""
        place = device.ports[:-1]
        return tuple(one for one in self.devices
                     if one.bus == device.bus and one.ports[:-1] == place and one.ports != device.ports)  # fmt: skip


def read_tree(machine: Machine) -> UsbTree:
    """Return the tree; empty where the system shows none. What cannot be understood is left out, never an error."""
    try:
        entries = sorted(machine.usb_devices.iterdir())
    except OSError:
        entries = []
    drivers = _interface_drivers(entries)
    buses = [_bus(entry) for entry in entries]
    devices = [_device(entry, drivers.get(entry.name, ())) for entry in entries]
    found = sorted((one for one in devices if one is not None), key=lambda one: (one.bus, one.ports))
    return UsbTree({one.number: one for one in buses if one is not None}, tuple(found))


def _bus(entry: Path) -> UsbBus | None:
    match = _ROOT.fullmatch(entry.name)
    if match is None:
        return None
    try:
        chip = entry.resolve().parent
    except (OSError, RuntimeError):  # RuntimeError: links that lead in a circle
        return None
    return UsbBus(int(match[1]), _printable(chip.name), _linked(chip / "driver"), _speed(entry))


def _device(entry: Path, drivers: tuple[str, ...]) -> UsbDevice | None:
    match = _DEVICE.fullmatch(entry.name)
    vendor, product = number_of(entry / "idVendor", 16), number_of(entry / "idProduct", 16)
    address = number_of(entry / "devnum")
    if match is None or vendor is None or product is None or address is None or max(vendor, product) > 0xFFFF:
        return None
    return UsbDevice(
        bus=int(match[1]),
        address=address,
        ports=tuple(int(port) for port in match[2].split(".")),
        vendor=vendor,
        product=product,
        release=number_of(entry / "bcdDevice", 16) or 0,
        maker=text_of(entry / "manufacturer")[:LONGEST_TEXT],
        name=text_of(entry / "product")[:LONGEST_TEXT],
        serial=text_of(entry / "serial")[:LONGEST_TEXT],
        speed_mbps=_speed(entry),
        usb=_decimal(text_of(entry / "version")),
        drivers=drivers,
    )


def _interface_drivers(entries: list[Path]) -> dict[str, tuple[str, ...]]:
    """Return the kernel's drivers by the name of the device whose interfaces they hold."""
    held: dict[str, tuple[str, ...]] = {}
    for entry in entries:
        device, colon, _ = entry.name.partition(":")
        driver = _linked(entry / "driver") if colon else ""
        if driver and driver not in held.get(device, ()):
            held[device] = (*held.get(device, ()), driver)
    return held


def _linked(link: Path) -> str:
    """Return the name of what a link leads to; empty where it is none."""
    try:
        return _printable(link.readlink().name)
    except OSError:
        return ""


def _printable(name: str) -> str:
    return "".join(one if one.isprintable() else "?" for one in name)[:LONGEST_TEXT]


def _speed(entry: Path) -> float:
    return _decimal(text_of(entry / "speed"))


def _decimal(text: str) -> float:
    match = re.fullmatch(r"\d{1,6}(?:\.\d{1,3})?", text, re.ASCII)
    return 0.0 if match is None else float(text)
