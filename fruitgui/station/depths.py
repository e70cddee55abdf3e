"""The depth corrections of a line's devices, by serial: they outlive stations, names and places on the rig."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import datetime
from typing import Annotated

from pydantic import AwareDatetime, Field, FiniteFloat

from fruitgui.calibration.depth.measured import DepthFit
from fruitgui.sensors.depth_correction import DepthCorrection
from fruitgui.station.matching import same_sensor
from fruitgui.station.station import Station
from fruitgui.station.station_file import CorrectionPart
from fruitgui.station.written import Written

FourNumbers = Annotated[tuple[FiniteFloat, ...], Field(min_length=4, max_length=4)]


class KeptFigure(Written):
    """One length before and after, m; see `calibration.depth.measured.Figure`."""

    what: str
    typed_m: FiniteFloat
    before_m: FiniteFloat
    after_m: FiniteFloat
    std_m: FiniteFloat


class DeviceDepth(Written):
    """What is known of one device's depth.

    Attributes:
        correction: None where a person took it away again.
        measured_at: when.
        covariance: (4, 4) of scale, offset_m, radial_2, radial_4.
        distance_m: of the belt when it was measured.
        depth_std_m: of a corrected depth at that distance.
        figures: lengths before and after.
    """

    correction: CorrectionPart | None = None
    measured_at: AwareDatetime | None = None
    covariance: Annotated[tuple[FourNumbers, ...], Field(min_length=4, max_length=4)] | None = None
    distance_m: FiniteFloat | None = None
    depth_std_m: FiniteFloat | None = None
    figures: tuple[KeptFigure, ...] = ()

    def depth_correction(self) -> DepthCorrection | None:
        """Return the correction as it is applied."""
        return None if self.correction is None else DepthCorrection(**self.correction.model_dump())


class DeviceDepths(Written):
    """All devices whose depth was measured, by their keys, see `device_key`."""

    devices: dict[str, DeviceDepth] = Field(default_factory=dict)

    def of(self, serial: str, name: str) -> DeviceDepth | None:
        """Return what is known of a device; None where it was never measured."""
        return self.devices.get(device_key(serial, name))

    def with_device(self, serial: str, name: str, device: DeviceDepth) -> DeviceDepths:
        """Return the same with a device measured, or its correction taken away."""
        return self.model_copy(update={"devices": {**self.devices, device_key(serial, name): device}})


def device_key(serial: str, name: str) -> str:
    """Return what a device is known by: its serial, or its name on the line where it tells none."""
    return f"serial {serial}" if serial else f"name {name}"


def device_depth(fit: DepthFit, measured_at: datetime) -> DeviceDepth:
    """Return what is kept of a measurement."""
    told = fit.correction
    return DeviceDepth(
        correction=CorrectionPart(
            scale=told.scale, offset_m=told.offset_m, radial_2=told.radial_2, radial_4=told.radial_4
        ),
        measured_at=measured_at,
        covariance=tuple(tuple(float(one) for one in row) for row in fit.covariance),
        distance_m=fit.distance_m,
        depth_std_m=fit.depth_std_m,
        figures=tuple(
            KeptFigure(what=one.what, typed_m=one.typed_m, before_m=one.before_m, after_m=one.after_m, std_m=one.std_m)
            for one in fit.figures
        ),
    )


def corrections_of(
    serials: Mapping[str, str], depths: DeviceDepths | None, station: Station | None
) -> dict[str, DepthCorrection]:
    """Return the corrections of sensors (name to serial), by name; a sensor without one is absent.

    What was measured of a device wins, also that its correction was taken away; else what a station says of it.
    """
    found = {}
    for name, serial in serials.items():
        known = None if depths is None else depths.of(serial, name)
        if known is not None:
            correction = known.depth_correction()
        else:
            before = None if station is None else same_sensor(station, name, serial)
            correction = None if station is None or before is None else station.sensors[before].depth_correction
        if correction is not None and not correction.is_none:
            found[name] = correction
    return found


def outdated(depths: DeviceDepths | None, station: Station) -> tuple[str, ...]:
    """Return the sensors of a station whose devices were measured to have another correction than it was made with."""
    serials = {name: sensor.serial for name, sensor in station.sensors.items()}
    now = corrections_of(serials, depths, station)
    return tuple(
        name
        for name, sensor in station.sensors.items()
        if now.get(name, DepthCorrection()) != (sensor.depth_correction or DepthCorrection())
    )
