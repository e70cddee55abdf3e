"""A short line with known truth, rendered once: its recording, its station, what crossed."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from pathlib import Path

import pytest

from fruitgui.gui.session import Session
from fruitgui.simulation.scenes import line_scene
from fruitgui.station.connection import connection_to
from fruitgui.station.fingerprint import calibration_fingerprint
from fruitgui.station.record_simulated import record_simulation
from fruitgui.station.sources import RecordedSource
from fruitgui.station.station import Station, StationSensor
from fruitgui.station.workflow_file import Marks
from fruitgui.station.workspace import Workspace
from tests.made_once import made_once

FRUIT = 6


@dataclass(frozen=True, slots=True, eq=False)
class LineRecording:
    """Where it is, the station with true poses, and how many pieces of each kind crossed."""

    path: Path
    station: Station
    truth: Counter[str]

    def set_up(self, session: Session) -> None:
        """Connect a session to it, as if every step before the live screen were done."""
        source = RecordedSource(self.path, speed=0.0)
        session.save_connection(connection_to(source.value(), source.connect().sensors))
        session.save_station(self.station)
        session.save_marks(self._marks())
        session.start_sensors()

    def lay_out(self, workspace: Workspace) -> None:
        """Write the files of a workspace in which every step before the live screen is done."""
        source = RecordedSource(self.path, speed=0.0)
        workspace.connection.save(connection_to(source.value(), source.connect().sensors))
        workspace.station.save(self.station)
        workspace.marks.save(self._marks())

    def _marks(self) -> Marks:
        return Marks(belt_calibration=calibration_fingerprint(self.station))


def line_recording(factory: pytest.TempPathFactory) -> LineRecording:
    """Return it, rendered unless it is there."""
    simulation = line_scene(11, fruit=FRUIT, speed_m_s=0.25)
    folder = made_once(factory, "line", lambda folder: record_simulation(simulation, folder / "line.mcap"))
    sensors = {
        name: StationSensor(simulation.device(name).serial, mount.pose, mount.surface)
        for name, mount in simulation.rig().mounts.items()
    }
    truth = Counter(one.kind for one in simulation.truth.fruit)
    return LineRecording(folder / "line.mcap", Station(simulation.rig().reference, sensors), truth)
