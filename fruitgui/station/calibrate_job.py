"""Calibrating a station from a recording of a still scene."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from fruitgui.calibration import Calibration, Reason, Refusal, calibrate
from fruitgui.errors import InputError
from fruitgui.frame import Frame
from fruitgui.progress import Cancelled, Progress, never_cancelled, no_progress, stop_if
from fruitgui.sensors.recordings import Recording
from fruitgui.station.source import RecordingSource
from fruitgui.station.station import Station, StationSensor
from fruitgui.station.station_file import write_station
from fruitgui.station.thinning import Thinned

FRAMES_PER_SENSOR = 30
"""More still frames of one sensor repeat each other: what is left is the device's own bias."""


@dataclass(frozen=True, slots=True)
class CalibrationOutcome:
    """What calibrating came to.

    Attributes:
        station: the station, or None where it was refused.
        quality: by sensor, for people.
        reasons: why it was refused; empty where accepted.
        warnings: what a person should know all the same.
    """

    station: Station | None
    quality: Mapping[str, Mapping[str, object]]
    reasons: tuple[Reason, ...]
    warnings: tuple[str, ...]

    @property
    def accepted(self) -> bool:
        """Whether there is a station."""
        return self.station is not None

    def value(self, path: Path) -> dict[str, Any]:
        """Return the contract's object."""
        return {
            "accepted": self.accepted,
            "station": str(path) if self.accepted else None,
            "sensors": {name: dict(quality) for name, quality in self.quality.items()},
            "reasons": [
                {"code": reason.code, "sensors": list(reason.sensors), "what": reason.what, "remedy": reason.remedy}
                for reason in self.reasons
            ],
            "warnings": list(self.warnings),
        }

    def lines(self, path: Path) -> list[str]:
        """Return what to tell a person."""
        lines = [f"  {name}: {_in_words(quality)}" for name, quality in self.quality.items()]
        if self.accepted:
            return [f"Calibrated {len(self.quality)} sensors.", *lines, f"Station: {path}"]
        return ["Not calibrated; nothing was written.", *lines]


def _in_words(quality: Mapping[str, object]) -> str:
    texts = []
    for name, value in quality.items():
        if isinstance(value, float) and math.isfinite(value):
            texts.append(f"{name} {value:.3g}")
        elif isinstance(value, str | int):
            texts.append(f"{name} {value}")
    return ", ".join(texts)


def calibrate_recording(
    source: RecordingSource,
    reference: str | None,
    out: Path,
    progress: Progress = no_progress,
    cancelled: Cancelled = never_cancelled,
) -> CalibrationOutcome:
    """Calibrate and, where accepted, write the station.

    Raises:
        InputError: the recording cannot be used, or has no sensor of the reference's name.
        WorldError: the station cannot be written.
    """
    recording = source.open()
    check_reference(recording, reference, source.path)
    stills = read_stills(recording, progress, cancelled)
    result = calibrate(stills, reference, lambda share, doing: progress(0.3 + 0.7 * share, doing), cancelled)
    warnings = (*recording.warnings, *result.warnings)
    if isinstance(result, Refusal):
        return CalibrationOutcome(None, result.quality, result.reasons, warnings)
    serials = {name: info.serial for name, info in recording.sensors.items()}
    station = station_of(result, serials, source.clock_offsets_s)
    write_station(out, station)
    return CalibrationOutcome(station, result.quality, (), warnings)


def check_reference(recording: Recording, reference: str | None, path: Path) -> None:
    """Raise `InputError` if the reference is not a sensor of the recording."""
    names = list(recording.sensors)
    if reference is not None and reference not in names:
        raise InputError(
            "no_such_sensor",
            f"There is no sensor {reference!r} in {path}; it has {', '.join(names)}.",
            "Name one of these as the reference.",
            file=path,
        )


def read_stills(
    recording: Recording, progress: Progress = no_progress, cancelled: Cancelled = never_cancelled
) -> dict[str, list[Frame]]:
    """Return up to `FRAMES_PER_SENSOR` frames of each sensor, spread over the whole recording."""
    kept = {name: Thinned[Frame](FRAMES_PER_SENSOR) for name in recording.sensors}
    for count, (_, frame) in enumerate(recording.frames()):
        stop_if(cancelled)
        kept[frame.sensor].add(frame)
        if count % 20 == 0:
            progress(0.3 * min(1.0, count / (FRAMES_PER_SENSOR * len(kept))), f"Read {count} frames")
    return {name: frames.items() for name, frames in kept.items() if frames.items()}


def station_of(result: Calibration, serials: Mapping[str, str], clock_offsets_s: Mapping[str, float]) -> Station:
    """Return the station of an accepted calibration."""
    sensors = {
        name: StationSensor(
            serial=serials.get(name, ""),
            pose=mount.pose,
            surface=mount.surface,
            clock_offset_s=clock_offsets_s.get(name, 0.0),
            quality=result.quality.get(name, {}),
        )
        for name, mount in result.rig.mounts.items()
    }
    return Station(result.rig.reference, sensors)


def with_model(station: Station, model: str) -> Station:
    """Return the station with the name of its model's file."""
    return replace(station, model=model)
