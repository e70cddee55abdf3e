"""The facts that the workflow judges, gathered from a workspace's files."""

from __future__ import annotations

from collections.abc import Collection

from fruitgui.station.connection import Connection
from fruitgui.station.depths import DeviceDepths, outdated
from fruitgui.station.fingerprint import calibration_fingerprint
from fruitgui.station.station import Station
from fruitgui.station.workflow import CalibrationFacts, Facts, ModelFacts, TaughtFacts
from fruitgui.station.workflow_file import Marks, ModelMark


def facts_of(
    connection: Connection | None,
    station: Station | None,
    marks: Marks | None,
    *,
    present: Collection[str] | None = None,
    taught: TaughtFacts | None = None,
    lots: int = 0,
    moved: bool = False,
    running: bool = False,
    depths: DeviceDepths | None = None,
) -> Facts:
    """Return the facts.

    Args:
        connection, station, marks: as the workspace holds them; None where it does not.
        present: names of the connection's sensors that are there; None where nobody looked yet.
        taught: samples, as the records know them.
        lots: how many were run.
        moved: the watch said that the rig was bumped since it was calibrated.
        running: the line runs now.
        depths: what was measured of the devices' depth.
    """
    marks = marks or Marks()
    serials = None if connection is None else connection.serials()
    missing = () if serials is None or present is None else tuple(name for name in serials if name not in present)
    return Facts(
        sensors=serials,
        reference=None if connection is None else connection.reference_name,
        missing=missing,
        calibration=None if station is None else _calibration(station, moved, depths),
        belt_calibration=marks.belt_calibration,
        taught=taught,
        model=None if station is None or station.model is None else _model(marks.models.get(station.model)),
        lots=lots,
        running=running,
    )


def _calibration(station: Station, moved: bool, depths: DeviceDepths | None) -> CalibrationFacts:
    serials = {name: sensor.serial for name, sensor in station.sensors.items()}
    return CalibrationFacts(
        calibration_fingerprint(station), serials, station.reference, moved, outdated(depths, station)
    )


def _model(mark: ModelMark | None) -> ModelFacts:
    """Return what is known of the model in use; one from elsewhere has no mark."""
    return ModelFacts(None, None, ()) if mark is None else ModelFacts(mark.calibration, mark.taught, mark.kinds)
