"""A line that is set up and trained on the simulated rig, for the window to open on."""

from __future__ import annotations

import tempfile
from dataclasses import replace
from pathlib import Path

from fruitgui.errors import WorldError
from fruitgui.evaluation.stage import Act, record_acts
from fruitgui.progress import Cancelled, Progress, never_cancelled, no_progress
from fruitgui.simulation.labels import truth_labels, write_labels
from fruitgui.simulation.supply import LineOptions
from fruitgui.station.calibrate_job import calibrate_recording
from fruitgui.station.connection import connection_to
from fruitgui.station.fingerprint import calibration_fingerprint
from fruitgui.station.source import RecordingSource
from fruitgui.station.sources import SimulatedSource
from fruitgui.station.station import Station
from fruitgui.station.train_job import train_recordings
from fruitgui.station.workflow_file import Marks, ModelMark
from fruitgui.station.workspace import Workspace

TRAINING_FRUIT = 50
TRAINING_SPEED_M_S = 0.2
REFERENCE_SHARE = 1 / 3


def set_up_line(
    workspace: Workspace, seed: int, progress: Progress = no_progress, cancelled: Cancelled = never_cancelled
) -> None:
    """Calibrate and train a workspace's line on the simulated rig of a seed, and connect it to that rig.

    Raises:
        WorldError: the rig cannot be calibrated (another seed can), or there is no room for its recordings.
        CancelledByUserError: `cancelled` said so.
    """
    source = SimulatedSource(LineOptions(rig_seed=seed, seed=seed), "opposed")
    workspace.connection.save(connection_to(source.value(), source.connect().sensors))
    acts = (
        Act("training", seed + 2, seed, TRAINING_FRUIT, speed_m_s=TRAINING_SPEED_M_S),
        Act("still", seed + 1, seed, 15),
    )
    with tempfile.TemporaryDirectory(prefix="fruitgui-demo-") as name:
        folder = Path(name)
        record_acts(acts, folder, lambda share, doing: progress(0.7 * share, doing), cancelled)
        _learn(workspace, acts, folder, progress, cancelled)


def _learn(workspace: Workspace, acts: tuple[Act, Act], folder: Path, progress: Progress, cancelled: Cancelled) -> None:
    """Calibrate and train from the recordings of both acts."""
    training, still = acts
    station_path, model_path, labels = folder / "station.json", folder / "model.fruit", folder / "labels.csv"
    progress(0.7, "Calibrating")
    outcome = calibrate_recording(RecordingSource(still.path(folder)), None, station_path, cancelled=cancelled)
    if outcome.station is None:
        raise WorldError("demo_refused", "The simulated rig could not be calibrated.", "Try another --seed.")
    progress(0.8, "Training")
    write_labels(labels, truth_labels(training.simulation, volume_share=REFERENCE_SHARE))
    trained = train_recordings(
        [(RecordingSource(training.path(folder)), labels)], station_path, model_path, cancelled=cancelled
    )
    model = workspace.add_model(trained.model)
    station = replace(outcome.station, model=model.name)
    workspace.station.save(station)
    workspace.marks.save(_marks(station, model.name, trained.model.kinds.kinds))


def _marks(station: Station, model: str, kinds: tuple[str, ...]) -> Marks:
    calibration = calibration_fingerprint(station)
    mark = ModelMark(calibration=calibration, kinds=tuple(kinds))
    return Marks(belt_calibration=calibration, models={model: mark})
