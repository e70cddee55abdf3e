"""The one list of what can be connected: real devices, simulated rigs, recordings."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, Protocol

from fruitgui.errors import InputError
from fruitgui.sensors.drivers import Driver, known_drivers
from fruitgui.sensors.held_color import held
from fruitgui.sensors.named import NamedSensor
from fruitgui.sensors.player import AtSpeed, FlatOut, recorded_sensors
from fruitgui.sensors.sensor import Sensor
from fruitgui.simulation.ahead import SimulatedRig
from fruitgui.simulation.supply import LineOptions

REMEDY = "Choose what to connect again."


@dataclass(frozen=True, slots=True)
class Connected:
    """What a source gave.

    Attributes:
        sensors: closed, not started; a feed runs them.
        rig: what can be asked of a simulated rig (`show`, `belt_s`); None for any other source.
    """

    sensors: Sequence[Sensor]
    rig: SimulatedRig | None = None


class Source(Protocol):
    """Where sensors come from. A record: asking twice gives sensors of the same devices."""

    @property
    def kind(self) -> str:
        """What sort of source it is, one word."""

    @property
    def name(self) -> str:
        """Which of its kind: a preset, a file's name, a device."""

    def value(self) -> dict[str, Any]:
        """Return it as JSON for `connection.json`."""

    def connect(self) -> Connected:
        """Return its sensors. Raises `FruitguiError` where it cannot be used."""


@dataclass(frozen=True, slots=True)
class SimulatedSource:
    """A rig that does not exist.

    Attributes:
        options: of rig and line.
        name: of the preset that it came from, or any other.
        flat_out: frames come as fast as they are rendered, not at their pace.
    """

    options: LineOptions
    name: str = "simulated"
    flat_out: bool = False

    @property
    def kind(self) -> str:
        """`simulated`."""
        return "simulated"

    def value(self) -> dict[str, Any]:
        """Return it as JSON."""
        return {"kind": self.kind, "name": self.name, "flat_out": self.flat_out, "options": asdict(self.options)}

    def connect(self) -> Connected:
        """Return the sensors, and the rig that one can ask to show something else."""
        rig = SimulatedRig(self.options, FlatOut() if self.flat_out else AtSpeed())
        return Connected(rig.sensors(), rig)


@dataclass(frozen=True, slots=True)
class RecordedSource:
    """A recording that plays as if its sensors were there.

    Attributes:
        path: of the file.
        speed: times its own pace; 0 for as fast as it can be read.
        looped: begin again at its end.
    """

    path: Path
    speed: float = 1.0
    looped: bool = False

    @property
    def kind(self) -> str:
        """`recording`."""
        return "recording"

    @property
    def name(self) -> str:
        """The file's name."""
        return self.path.name

    def value(self) -> dict[str, Any]:
        """Return it as JSON."""
        return {"kind": self.kind, "path": str(self.path), "speed": self.speed, "looped": self.looped}

    def connect(self) -> Connected:
        """Return the sensors. Raises `InputError` where the file cannot be used."""
        pace = AtSpeed(self.speed) if self.speed > 0 else FlatOut()
        return Connected(recorded_sensors(self.path, pace, looped=self.looped))


@dataclass(frozen=True, slots=True)
class DeviceId:
    """A device, plugged in or not."""

    make: str
    serial: str


Drivers = Callable[[], Sequence[Driver]]


@dataclass(frozen=True, slots=True)
class DevicesSource:
    """Real sensors, whether plugged in now or not.

    Attributes:
        devices: at least one, in order.
        drivers: gives the drivers that are asked for them.
    """

    devices: tuple[DeviceId, ...]
    drivers: Drivers = field(default=known_drivers, compare=False, repr=False)

    @property
    def kind(self) -> str:
        """`devices`."""
        return "devices"

    @property
    def name(self) -> str:
        """How many there are of each make, for example `2 kinect`."""
        return ", ".join(f"{count} {make}" for make, count in Counter(one.make for one in self.devices).items())

    def value(self) -> dict[str, Any]:
        """Return it as JSON."""
        return {"kind": self.kind, "devices": [asdict(device) for device in self.devices]}

    def connect(self) -> Connected:
        """Return a sensor for each device, named by its make and counted from 1; one that is away can come later.

        Raises:
            InputError: a make has no driver here.
        """
        drivers = {driver.make: driver for driver in self.drivers()}
        count: Counter[str] = Counter()
        sensors: list[Sensor] = []
        for device in self.devices:
            if device.make not in drivers:
                what = f"There is no driver for {device.make[:80]!r}; there are {', '.join(drivers) or 'none'}."
                raise InputError("bad_source", what, REMEDY)
            count[device.make] += 1
            sensor = held(drivers[device.make].sensor(device.serial))
            sensors.append(NamedSensor(sensor, f"{device.make}_{count[device.make]}"))
        return Connected(sensors)


def is_finite(value: Mapping[str, Any]) -> bool:
    """Tell whether the source of a value comes to an end and can be played again from its beginning."""
    return value.get("kind") == "recording" and not value.get("looped")


def is_plugged(value: Mapping[str, Any]) -> bool:
    """Tell whether the source of a value is devices, which give frames however busy this computer is."""
    return value.get("kind") == "devices"


@dataclass(frozen=True, slots=True)
class Make:
    """One kind of source.

    Attributes:
        kind: the word in a source's value.
        find: returns what of it is there now; quick, and never raises where nothing is.
        read: returns the source of a value; raises `TypeError`, `KeyError` or `ValueError` where it is none.
        asks_devices: finding may take a moment, or hang with a driver.
    """

    kind: str
    find: Callable[[], Sequence[Source]]
    read: Callable[[Mapping[str, Any]], Source]
    asks_devices: bool = False


PRESETS: Mapping[str, LineOptions] = {
    "opposed": LineOptions(rig_seed=1, layout="opposed"),
    "single": LineOptions(rig_seed=1, layout="single"),
    "chain": LineOptions(rig_seed=1, layout="chain"),
    "ring": LineOptions(rig_seed=1, layout="ring"),
    "opposed_touching": LineOptions(rig_seed=1, layout="opposed", touching=0.3, foreign=0.05),
    "opposed_fast": LineOptions(rig_seed=1, layout="opposed", speed_m_s=0.3, rate_hz=10.0),
    "opposed_projectors": LineOptions(rig_seed=1, layout="opposed", rate_hz=15.0, settling_s=0.15),
    "depth_off": LineOptions(rig_seed=1, layout="opposed", depth_error=1.0),
}
"""Simulated rigs by name; those named `opposed…` are one rig on different lines."""


def _read_simulated(value: Mapping[str, Any]) -> Source:
    known = dict(value["options"])
    options = LineOptions(**{**known, "kinds": tuple(known["kinds"])})
    options.setting()
    return SimulatedSource(options, str(value["name"]), bool(value["flat_out"]))


def _read_recorded(value: Mapping[str, Any]) -> Source:
    return RecordedSource(Path(value["path"]), float(value["speed"]), bool(value["looped"]))


def devices_of(drivers: Drivers) -> Make:
    """Return the make of devices of these drivers: all that are plugged in are one source."""

    def find() -> list[Source]:
        devices = (one for driver in drivers() for one in driver.devices())
        found = tuple(dict.fromkeys(DeviceId(one.make, one.serial) for one in devices if one.serial))
        return [DevicesSource(found, drivers)] if found else []

    def read(value: Mapping[str, Any]) -> Source:
        devices = tuple(DeviceId(str(one["make"]), str(one["serial"])) for one in value["devices"])
        if not devices:
            raise ValueError("it names no device")
        if len(set(devices)) != len(devices):
            raise ValueError("it names a device twice")
        return DevicesSource(devices, drivers)

    return Make("devices", find, read, asks_devices=True)


DEVICES = devices_of(known_drivers)
SIMULATED = Make("simulated", lambda: [SimulatedSource(one, name) for name, one in PRESETS.items()], _read_simulated)
RECORDINGS = Make("recording", list, _read_recorded)


@dataclass(frozen=True, slots=True)
class Sources:
    """All makes that this program knows; a driver adds its own.

    Attributes:
        makes: in the order in which they are listed.
    """

    makes: Sequence[Make] = field(default=(DEVICES, SIMULATED, RECORDINGS))

    def found(self) -> list[Source]:
        """Return everything that can be connected now."""
        return [source for make in self.makes for source in make.find()]

    def source_of(self, value: Mapping[str, Any]) -> Source:
        """Return the source that `connection.json` names.

        Raises:
            InputError: it is of no known make, or cannot be read.
        """
        kind = value.get("kind")
        make = next((one for one in self.makes if one.kind == kind), None)
        if make is None:
            kinds = ", ".join(one.kind for one in self.makes)
            raise InputError("bad_source", f"There is no source {str(kind)[:80]!r}; there are {kinds}.", REMEDY)
        try:
            return make.read(value)
        except (TypeError, KeyError, ValueError) as error:
            raise InputError("bad_source", f"The source cannot be read: {str(error)[:120]}.", REMEDY) from error
