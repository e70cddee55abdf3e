"""What the USB tree shows and what drivers list, joined: one record for each sensor."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from fruitgui.sensors.drivers import PluggedDevice
from fruitgui.sensors.sensor import Sensor
from fruitgui.sensors.usb.findings import SeenSensor, UsbView
from fruitgui.sensors.usb.problems import Problem, problem
from fruitgui.station.checkup.asking import Answer
from fruitgui.station.checkup.records import CheckedSensor, SensorState, UsbPlace

BLOCKING = {
    "unsupported": SensorState.NO_DRIVER,
    "no_access": SensorState.NO_ACCESS,
    "no_access_yet": SensorState.NO_ACCESS,
    "no_node": SensorState.NO_ACCESS,
    "not_found": SensorState.FAILED,
    "closed": SensorState.FAILED,
    "no_serial": SensorState.FAILED,
    "hangs": SensorState.HANGS,
    "busy": SensorState.BUSY,
}
"""The state that a problem puts a sensor into while nothing was measured, the gravest first."""


@dataclass(frozen=True, slots=True, eq=False)
class Joined:
    """A sensor as all know it.

    Attributes:
        checked: it, not measured.
        sensor: to run it with, closed; None where no driver lists it.
    """

    checked: CheckedSensor
    sensor: Sensor | None = None


def joined(view: UsbView, answers: Sequence[Answer], known_as: Mapping[str, str]) -> tuple[Joined, ...]:
    """Return every sensor once: those that drivers list, in their order, then those that only the USB shows.

    Args:
        view: of the USB.
        answers: of the drivers.
        known_as: names that people gave, by serial; other sensors are counted by make, as connecting them does.
    """
    left = list(view.sensors)
    names = _Names(known_as)
    listed = [(device, sensor) for answer in answers for device, sensor in answer.found]
    devices = [device for device, _ in listed]
    together = []
    for device, sensor in listed:
        seen = _seen(device, left)
        if seen is not None:
            left.remove(seen)
        together.append(Joined(_listed(device, seen, view, names.of(device.make, device.serial), devices), sensor))
    by_make = {answer.make: answer for answer in answers}
    for seen in left:
        make = seen.known.make
        together.append(Joined(_only_seen(seen, view, names.of(make, seen.device.serial), by_make.get(make))))
    return tuple(together)


class _Names:
    """Gives each sensor a name of its own."""

    def __init__(self, known_as: Mapping[str, str]) -> None:
        self._known_as = known_as
        self._taken = set(known_as.values())
        self._count: Counter[str] = Counter()

    def of(self, make: str, serial: str) -> str:
        if serial in self._known_as:
            return self._known_as[serial]
        while True:
            self._count[make] += 1
            name = f"{make}_{self._count[make]}"
            if name not in self._taken:
                return name


def _told_apart(device: PluggedDevice, devices: Sequence[PluggedDevice]) -> Problem | None:
    """Return what is wrong with a device's serial. One without any can be opened by being the only one of its make."""
    alike = [one.serial == device.serial for one in devices if one.make == device.make]
    if sum(alike) == 1 and device.serial.strip("0 "):
        return None
    has_none = bool(device.serial) or device.hindrance == "no_serial"
    if len(alike) == 1 and has_none:
        return problem("no_serial_alone")
    return problem(device.hindrance or ("no_serial" if device.serial else "closed"))


def _seen(device: PluggedDevice, seen: Sequence[SeenSensor]) -> SeenSensor | None:
    """Return the sensor on the USB that a driver lists: by its address, by a serial, or as the only one left."""
    same = [one for one in seen if one.known.make == device.make and device.bus in (None, one.device.bus)]
    if device.address is not None:
        return next((one for one in same if one.device.address == device.address), None)
    by_serial = [one for one in same if device.serial in one.serials]
    return by_serial[0] if by_serial else same[0] if len(same) == 1 else None


def _listed(
    device: PluggedDevice, seen: SeenSensor | None, view: UsbView, name: str, devices: Sequence[PluggedDevice]
) -> CheckedSensor:
    problems = () if seen is None else seen.problems
    alike = _told_apart(device, devices)
    if alike is not None and not any(one.code in BLOCKING for one in problems):
        problems = (*problems, alike)
    place = _place(seen, view) if seen is not None else _told_place(device, view)
    return CheckedSensor(
        name, device.make, device.model, device.serial, _state(problems), problems, device.limits, device.firmware,
        place=place,
    )  # fmt: skip


def _only_seen(seen: SeenSensor, view: UsbView, name: str, answer: Answer | None) -> CheckedSensor:
    problems, state = seen.problems, None
    if answer is None:
        problems = (problem("unsupported", model=seen.known.model), *problems)
    elif answer.unusable is not None:
        problems, state = (answer.unusable, *problems), SensorState.NO_DRIVER
    elif answer.problem is not None:
        state = SensorState.HANGS if answer.problem.code == "driver_hangs" else SensorState.FAILED
    elif not any(one.code in BLOCKING for one in problems):
        problems = (problem("not_found"), *problems)
    known, device = seen.known, seen.device
    return CheckedSensor(
        name, known.make, known.model, device.serial, state or _state(problems), problems, place=_place(seen, view)
    )


def _state(problems: Sequence[Problem]) -> SensorState:
    codes = {one.code for one in problems}
    return next((state for code, state in BLOCKING.items() if code in codes), SensorState.READY)


def _place(seen: SeenSensor, view: UsbView) -> UsbPlace:
    device = seen.device
    return UsbPlace(device.bus, view.tree.controller(device.bus), device.path, device.speed_mbps or None)


def _told_place(device: PluggedDevice, view: UsbView) -> UsbPlace:
    """Return what the driver tells of a place that the system does not show."""
    known = device.bus is not None and bool(device.port_path)
    port = f"{device.bus}-{'.'.join(str(one) for one in device.port_path)}" if known else None
    return UsbPlace(device.bus, view.tree.controller(device.bus), port)
