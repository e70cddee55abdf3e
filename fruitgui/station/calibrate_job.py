"""Calibrating a station from a recording of a still scene."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from fruitgui.calibration.calibrate import calibrate
from fruitgui.calibration.result import Calibration, PairQuality, Reason, Refusal, SensorQuality
from fruitgui.errors import InputError
from fruitgui.frame import Frame
from fruitgui.progress import Cancelled, Progress, never_cancelled, no_progress, stop_if
from fruitgui.sensors.depth_correction import DepthCorrection
from fruitgui.sensors.recordings import Recording
from fruitgui.station.depths import DeviceDepths, corrections_of
from fruitgui.station.lineup import unheard
from fruitgui.station.matching import same_sensor
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
        sensors: quality by sensor.
        pairs: quality of every pair that was tried.
        reasons: why it was refused; empty where accepted.
        warnings: what a person should know all the same.
    """

    station: Station | None
    sensors: Mapping[str, SensorQuality]
    pairs: tuple[PairQuality, ...]
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
            "sensors": {name: quality_value(quality) for name, quality in self.sensors.items()},
            "pairs": [quality_value(pair) for pair in self.pairs],
            "reasons": [
                {"code": reason.code, "sensors": list(reason.sensors), "what": reason.what, "remedy": reason.remedy}
                for reason in self.reasons
            ],
            "warnings": list(self.warnings),
        }

    def lines(self, path: Path) -> list[str]:
        """Return what to tell a person."""
        if not self.accepted:
            return ["Not calibrated; nothing was written."]
        placed = [f"  {name:<16} {_in_words(quality)}" for name, quality in self.sensors.items()]
        many = "1 sensor" if len(placed) == 1 else f"{len(placed)} sensors"
        return [f"Calibrated {many}.", *placed, f"Station: {path}"]


def _in_words(quality: SensorQuality) -> str:
    position_mm, angle_deg = quality.position_std_m * 1e3, math.degrees(quality.angle_std_rad)
    flat = f"belt flat within {quality.surface_rms_m * 1e3:.1f} mm"
    if position_mm == angle_deg == 0:
        return f"{quality.word}: the reference, {flat}"
    return f"{quality.word}: placed within ±{1.96 * position_mm:.1f} mm and ±{1.96 * angle_deg:.2f}° (95 %), {flat}"


def quality_value(quality: SensorQuality | PairQuality) -> dict[str, Any]:
    """Return a quality record as JSON; what is not a finite number is null."""
    value = asdict(quality)
    return {name: None if isinstance(one, float) and not math.isfinite(one) else one for name, one in value.items()}


def calibrate_recording(
    source: RecordingSource,
    reference: str | None,
    out: Path,
    progress: Progress = no_progress,
    cancelled: Cancelled = never_cancelled,
    depths: DeviceDepths | None = None,
) -> CalibrationOutcome:
    """Calibrate and, where accepted, write the station; `depths` is what is known of the devices' depth.

    Raises:
        InputError: the recording cannot be used, or has no sensor of the reference's name.
        WorldError: the station cannot be written.
    """
    recording = source.open()
    check_reference(recording, reference, source.path)
    mistaken = unheard(source.clock_offsets_s, recording.sensors)
    serials = {name: info.serial for name, info in recording.sensors.items()}
    corrections = corrections_of(serials, depths, None)
    stills = read_stills(recording, progress, cancelled, corrections)
    outcome = calibrate_stills(
        stills, reference, serials, source.clock_offsets_s,
        lambda share, doing: progress(0.3 + 0.7 * share, doing), cancelled,
    )  # fmt: skip
    if outcome.station is not None:
        station = with_corrections(outcome.station, corrections)
        write_station(out, station)
        outcome = replace(outcome, station=station)
    return replace(outcome, warnings=(*recording.warnings, *outcome.warnings, *mistaken))


def calibrate_stills(
    stills: Mapping[str, Sequence[Frame]],
    reference: str | None,
    serials: Mapping[str, str],
    clock_offsets_s: Mapping[str, float] | None = None,
    progress: Progress = no_progress,
    cancelled: Cancelled = never_cancelled,
) -> CalibrationOutcome:
    """Calibrate from frames of a still scene; nothing is written.

    Args:
        stills: by sensor; the reference is the first unless named.
        reference: the sensor in whose frame all is measured.
        serials, clock_offsets_s: by sensor, kept in the station.
        progress, cancelled: as for any job.

    Raises:
        InputError: no sensors, no frames of one, or an unknown reference.
        CancelledByUserError: `cancelled` said so.
    """
    result = calibrate(stills, reference, progress, cancelled)
    if isinstance(result, Refusal):
        return CalibrationOutcome(None, result.sensors, result.pairs, result.reasons, tuple(result.warnings))
    station = station_of(result, serials, clock_offsets_s or {})
    return CalibrationOutcome(station, result.sensors, result.pairs, (), tuple(result.warnings))


def calibrate_again(
    stills: Mapping[str, Sequence[Frame]],
    reference: str | None,
    serials: Mapping[str, str],
    before: Station | None,
    depths: DeviceDepths | None = None,
    progress: Progress = no_progress,
    cancelled: Cancelled = never_cancelled,
) -> CalibrationOutcome:
    """Calibrate from raw frames of sensors that run; what is known of each device, by its serial, is kept.

    That is its depth correction, which is applied to the frames first, its clock, and the station's model. Region and
    velocity of the belt are not kept: they go with the poses.

    Args:
        stills, reference, serials: as `calibrate_stills`.
        before: the station until now.
        depths: what was measured of the devices; it wins over the station before.
        progress, cancelled: as for any job.

    Raises:
        InputError, CancelledByUserError: as `calibrate_stills`.
    """
    corrections = corrections_of({name: serials.get(name, "") for name in stills}, depths, before)
    offsets_s = _clock_offsets_s(stills, serials, before)
    corrected = corrected_stills(stills, corrections)
    outcome = calibrate_stills(corrected, reference, serials, offsets_s, progress, cancelled)
    if outcome.station is None:
        return outcome
    station = with_corrections(outcome.station, corrections)
    return replace(outcome, station=station if before is None else with_model(station, before.model))


def _clock_offsets_s(names: Iterable[str], serials: Mapping[str, str], before: Station | None) -> dict[str, float]:
    if before is None:
        return {}
    same = {name: same_sensor(before, name, serials.get(name, "")) for name in names}
    return {name: before.sensors[known].clock_offset_s for name, known in same.items() if known is not None}


def corrected_stills(
    stills: Mapping[str, Sequence[Frame]], corrections: Mapping[str, DepthCorrection]
) -> dict[str, list[Frame]]:
    """Return raw frames with depth put right."""
    none = DepthCorrection()
    return {name: [corrections.get(name, none).corrected(frame) for frame in some] for name, some in stills.items()}


def with_corrections(station: Station, corrections: Mapping[str, DepthCorrection]) -> Station:
    """Return a station that was made of frames corrected so."""
    sensors = {name: replace(one, depth_correction=corrections.get(name)) for name, one in station.sensors.items()}
    return replace(station, sensors=sensors)


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
    recording: Recording,
    progress: Progress = no_progress,
    cancelled: Cancelled = never_cancelled,
    corrections: Mapping[str, DepthCorrection] | None = None,
) -> dict[str, list[Frame]]:
    """Return up to `FRAMES_PER_SENSOR` frames of each sensor, spread over the whole recording, depth put right."""
    kept = {name: Thinned[Frame](FRAMES_PER_SENSOR) for name in recording.sensors}
    for count, (_, frame) in enumerate(recording.frames(corrections=corrections)):
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
            quality={**quality_value(result.sensors[name]), "links": _links(name, result.pairs)},
        )
        for name, mount in result.rig.mounts.items()
    }
    return Station(result.rig.reference, sensors)


def _links(sensor: str, pairs: Sequence[PairQuality]) -> dict[str, dict[str, Any]]:
    """Return how well the sensor agrees with each other one that it was linked to."""
    mine = [pair for pair in pairs if pair.accepted and sensor in pair.sensors]
    return {next(one for one in pair.sensors if one != sensor): quality_value(pair) for pair in mine}


def with_model(station: Station, model: str | None) -> Station:
    """Return the station with the name of its model's file."""
    return replace(station, model=model)
