"""The station file, `fruitgui.station/1`: read with every doubt, written whole."""

from __future__ import annotations

import re
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, FiniteFloat, ValidationError, model_validator

from fruitgui.errors import InputError
from fruitgui.files import read_json, write_json
from fruitgui.frame import F64
from fruitgui.geometry.plane import Plane, Surface
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rotation import is_rotation, nearest_rotation
from fruitgui.sensors.depth_correction import DepthCorrection
from fruitgui.station.station import Station, StationSensor

SCHEMA = "fruitgui.station/1"
REMEDY = "Calibrate again, or name a station file that calibrating wrote."
SENSOR_ID = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,63}")
FARTHEST_M = 100.0
"""No rig is larger; a translation beyond it is a slip of units or of the file."""

FARTHEST_BELT_M = 10.0
"""No depth beyond it is looked at: a plane that far is no belt, but a slip of units, or of the file."""

FASTEST_M_S = 10.0
LONGEST_OFFSET_S = 1e10
"""Clocks that count from different years differ by less; beyond it a double has no milliseconds left."""

LEAST_REGION_M2 = 1e-4
"""No fruit lies on less than a square centimetre: such a region is a line, a point or a slip of units."""

Metres = Annotated[FiniteFloat, Field(ge=-FARTHEST_M, le=FARTHEST_M)]
Vector = Annotated[list[Metres], Field(min_length=3, max_length=3)]
Speed = Annotated[FiniteFloat, Field(ge=-FASTEST_M_S, le=FASTEST_M_S)]
Velocity = Annotated[list[Speed], Field(min_length=3, max_length=3)]
Offset = Annotated[FiniteFloat, Field(ge=-LONGEST_OFFSET_S, le=LONGEST_OFFSET_S)]
Heights = Annotated[list[Annotated[FiniteFloat, Field(gt=0.0, le=1.0)]], Field(min_length=2, max_length=2)]
UnitRow = Annotated[list[FiniteFloat], Field(min_length=3, max_length=3)]
Matrix3 = Annotated[list[UnitRow], Field(min_length=3, max_length=3)]
CovarianceRow = Annotated[list[FiniteFloat], Field(min_length=6, max_length=6)]
Matrix6 = Annotated[list[CovarianceRow], Field(min_length=6, max_length=6)]


class _Part(BaseModel):
    # Strict: neither "1.0" nor true is a number.
    model_config = ConfigDict(extra="ignore", strict=True)


class PosePart(_Part):
    """A pose as the file has it."""

    rotation: Matrix3
    translation_m: Vector
    covariance: Matrix6 | None = None

    @model_validator(mode="after")
    def _check(self) -> PosePart:
        if not is_rotation(np.array(self.rotation)):
            raise ValueError("rotation is not orthonormal and right-handed within 1e-4")
        if self.covariance is not None:
            covariance = np.array(self.covariance)
            size = max(float(np.abs(covariance).max()), 1e-30)
            if np.abs(covariance - covariance.T).max() > 1e-6 * size:
                raise ValueError("covariance is not symmetric")
            if np.linalg.eigvalsh(covariance).min() < -1e-6 * size:
                raise ValueError("covariance has a negative variance")
        return self

    def pose(self) -> Pose:
        """Return the pose, its rotation made exactly orthonormal."""
        covariance = None if self.covariance is None else np.array(self.covariance, dtype=np.float64)
        return Pose(nearest_rotation(np.array(self.rotation)), np.array(self.translation_m), covariance)


class SurfacePart(_Part):
    """A surface as the file has it."""

    normal: UnitRow
    offset_m: Annotated[FiniteFloat, Field(ge=-FARTHEST_BELT_M, le=FARTHEST_BELT_M)]
    region: Annotated[list[Vector], Field(min_length=3, max_length=10_000)] | None = None

    @model_validator(mode="after")
    def _check(self) -> SurfacePart:
        length = float(np.linalg.norm(self.normal))
        if abs(length - 1.0) > 1e-3:
            raise ValueError(f"normal has length {length:.4g}, not 1")
        if self.offset_m == 0.0:
            raise ValueError("the plane goes through the sensor itself")
        if self.region is not None and _area_m2(self.surface()) < LEAST_REGION_M2:
            raise ValueError("the region has no area")
        return self

    def surface(self) -> Surface:
        """Return the surface, normal to the sensor's side, region laid on the plane."""
        length = float(np.linalg.norm(self.normal))
        plane = Plane(np.array(self.normal) / length, self.offset_m / length).facing(np.zeros(3))
        return Surface(plane, None if self.region is None else plane.foot(np.array(self.region)))


def _area_m2(surface: Surface) -> float:
    """Return the area that the region's corners, in their order, go round."""
    assert surface.region_m is not None  # noqa: S101 - asked only where there is one
    corners = surface.region_m - surface.region_m[0]
    return 0.5 * abs(float(np.cross(corners[:-1], corners[1:]).sum(axis=0) @ surface.plane.normal))


class CorrectionPart(_Part):
    """A device's depth correction as the file has it."""

    scale: Annotated[FiniteFloat, Field(gt=0.5, lt=2.0)] = 1.0
    offset_m: Annotated[FiniteFloat, Field(gt=-0.5, lt=0.5)] = 0.0
    radial_2: Annotated[FiniteFloat, Field(gt=-1.0, lt=1.0)] = 0.0
    radial_4: Annotated[FiniteFloat, Field(gt=-1.0, lt=1.0)] = 0.0


class SensorPart(_Part):
    """A sensor as the file has it."""

    serial: str | None = None
    pose: PosePart
    surface: SurfacePart
    clock_offset_s: Offset = 0.0
    depth_correction: CorrectionPart | None = None
    quality: dict[str, Any] = {}

    def sensor(self) -> StationSensor:
        """Return the record."""
        part = self.depth_correction
        correction = None if part is None else DepthCorrection(**part.model_dump())
        return StationSensor(
            self.serial or "", self.pose.pose(), self.surface.surface(), self.clock_offset_s, correction, self.quality
        )


class BeltPart(_Part):
    """The belt as the file has it."""

    velocity_m_s: Velocity | None = None
    fruit_heights_m: Heights | None = None

    @model_validator(mode="after")
    def _check(self) -> BeltPart:
        if self.fruit_heights_m is not None and not self.fruit_heights_m[0] < self.fruit_heights_m[1]:
            raise ValueError("the shortest fruit is not shorter than the tallest")
        return self

    def heights(self) -> tuple[float, float] | None:
        """Return the shortest and the tallest fruit's height, m."""
        return None if self.fruit_heights_m is None else (self.fruit_heights_m[0], self.fruit_heights_m[1])


class StationPart(_Part):
    """The whole file."""

    schema_: Literal["fruitgui.station/1"] = Field(alias="schema")
    reference_sensor: str
    sensors: Annotated[dict[str, SensorPart], Field(min_length=1, max_length=256)]
    belt: BeltPart = BeltPart()
    model: str | None = None

    @model_validator(mode="after")
    def _check(self) -> StationPart:
        for name in self.sensors:
            if not SENSOR_ID.fullmatch(name):
                raise ValueError(f"sensor id {name[:80]!r} is not letters, digits and _ beginning with a letter")
        reference = self.sensors.get(self.reference_sensor)
        if reference is None:
            raise ValueError(f"reference_sensor {self.reference_sensor[:80]!r} is not among the sensors")
        identity = Pose()
        pose = reference.pose.pose()
        if np.abs(pose.matrix - identity.matrix).max() > 1e-3:
            raise ValueError("the reference sensor's own pose is not the identity")
        return self


def read_station(path: Path) -> Station:
    """Return the station in a file.

    Raises:
        InputError: unreadable, not JSON, another schema, or any field that cannot be; says which.
    """
    return station_of(read_json(path), path)


def station_of(value: Any, path: Path) -> Station:  # noqa: ANN401 - JSON is any
    """Return the station that a file's JSON value holds.

    Args:
        value: as JSON has it.
        path: of the file, for messages.

    Raises:
        InputError: another schema, or any field that cannot be; says which.
    """
    if not isinstance(value, dict) or value.get("schema") != SCHEMA:
        found = value.get("schema") if isinstance(value, dict) else None
        raise InputError(
            "bad_station", f"{path} is not a station of version {SCHEMA} (found {str(found)[:80]!r}).", REMEDY,
            file=path, where="schema",
        )  # fmt: skip
    try:
        part = StationPart.model_validate(value)
    except ValidationError as error:
        raise _bad_station(path, error) from error
    sensors = {name: sensor.sensor() for name, sensor in part.sensors.items()}
    velocity = None if part.belt.velocity_m_s is None else np.array(part.belt.velocity_m_s, dtype=np.float64)
    return Station(part.reference_sensor, sensors, velocity, part.model, part.belt.heights())


def _bad_station(path: Path, error: ValidationError) -> InputError:
    first = error.errors(include_input=False, include_url=False)[0]
    where = ".".join(str(step)[:80] for step in first["loc"]) or "top level"
    message = first["msg"].removeprefix("Value error, ")
    return InputError("bad_station", f"{path}: {where}: {message}.", REMEDY, file=path, where=where)


def write_station(path: Path, station: Station) -> None:
    """Write a station, whole or not at all.

    Raises:
        WorldError: it cannot be written there.
    """
    write_json(path, station_value(station))


def station_value(station: Station) -> dict[str, Any]:
    """Return the station as the JSON value of its file."""
    return {
        "schema": SCHEMA,
        "reference_sensor": station.reference,
        "sensors": {name: _sensor_value(sensor) for name, sensor in station.sensors.items()},
        "belt": _belt_value(station),
        "model": station.model,
    }


def _belt_value(station: Station) -> dict[str, Any]:
    value: dict[str, Any] = {"velocity_m_s": _list(station.velocity_m_s)}
    if station.fruit_heights_m is not None:
        value["fruit_heights_m"] = list(station.fruit_heights_m)
    return value


def _sensor_value(sensor: StationSensor) -> dict[str, Any]:
    correction = sensor.depth_correction
    return {
        "serial": sensor.serial,
        "pose": {
            "rotation": _list(sensor.pose.rotation),
            "translation_m": _list(sensor.pose.translation_m),
            "covariance": _list(sensor.pose.covariance),
        },
        "surface": {
            "normal": _list(sensor.surface.plane.normal),
            "offset_m": float(sensor.surface.plane.offset_m),
            "region": _list(sensor.surface.region_m),
        },
        "clock_offset_s": sensor.clock_offset_s,
        "depth_correction": None if correction is None else asdict(correction),
        "quality": dict(sensor.quality),
    }


def _list(array: F64 | None) -> Any:  # noqa: ANN401 - nested lists of any depth
    return None if array is None else np.asarray(array, dtype=np.float64).tolist()
