"""The whole way on simulated recordings: calibrate, train, run, and hold the report against the truth."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from fruitgui.classification.evidence import UNKNOWN
from fruitgui.evaluation.metrics import Metric, mean, share
from fruitgui.evaluation.scoring import Score, covered, relative_errors, score, size_errors_mm
from fruitgui.evaluation.stage import Act, record_acts
from fruitgui.frame import F64
from fruitgui.geometry.pose import Pose
from fruitgui.progress import Cancelled, Progress, never_cancelled, no_progress
from fruitgui.simulation.labels import truth_labels, write_labels
from fruitgui.simulation.simulation import Simulation
from fruitgui.station.calibrate_job import CalibrationOutcome, calibrate_recording
from fruitgui.station.run_job import RunOptions, run_recording
from fruitgui.station.source import RecordingSource
from fruitgui.station.train_job import TrainOutcome, train_recordings

REFERENCE_SHARE = 1 / 3
"""Share of the training fruit whose volume was read on a beaker."""


@dataclass(frozen=True, slots=True)
class Acts:
    """The three scenes of one rig."""

    still: Act
    training: Act
    line: Act


@dataclass(frozen=True, slots=True, eq=False)
class Chain:
    """What came of it.

    Attributes:
        calibration: accepted or refused; where refused the rest is None.
        training: of the model.
        report: of the run.
        score: of the report.
        warnings: of all jobs.
    """

    calibration: CalibrationOutcome
    training: TrainOutcome | None
    report: dict[str, Any] | None
    score: Score | None
    warnings: tuple[str, ...]


def run_chain(
    acts: Acts,
    folder: Path,
    *,
    progress: Progress = no_progress,
    cancelled: Cancelled = never_cancelled,
) -> Chain:
    """Render the scenes into `folder` and go the whole way by the same jobs as the command line.

    Raises:
        CancelledByUserError: `cancelled` said so.
    """
    record_acts(
        (acts.line, acts.training, acts.still), folder, lambda share, doing: progress(0.5 * share, doing), cancelled
    )
    station, model, labels = folder / "station.json", folder / "model.fruit", folder / "labels.csv"
    progress(0.5, "Calibrating")
    calibration = calibrate_recording(RecordingSource(acts.still.path(folder)), None, station, cancelled=cancelled)
    if not calibration.accepted:
        return Chain(calibration, None, None, None, calibration.warnings)
    write_labels(labels, truth_labels(acts.training.simulation, volume_share=REFERENCE_SHARE))
    progress(0.6, "Training")
    labelled = [(RecordingSource(acts.training.path(folder)), labels)]
    training = train_recordings(labelled, station, model, cancelled=cancelled)
    progress(0.8, "Running the line")
    line = RecordingSource(acts.line.path(folder))
    report = run_recording(line, station, RunOptions(model=model), cancelled=cancelled)
    warnings = (*calibration.warnings, *training.warnings, *report["warnings"])
    judged = score(report["fruit"], acts.line.simulation.truth)
    return Chain(calibration, training, report, judged, warnings)


def accuracy(judged: Score, kinds: tuple[str, ...]) -> dict[str, Metric]:
    """Return what a run was right and wrong by; volumes and sizes over fruit, foreign objects apart."""
    fruit = [pair for pair in judged.pairs if pair.true.kind in kinds]
    foreign = [pair for pair in judged.pairs if pair.true.kind not in kinds]
    things = len(judged.pairs) + len(judged.lost)
    wrong = len(judged.lost) + len(judged.double) + len(judged.phantom)
    right = sum(pair.reported["kind"] == pair.true.kind for pair in fruit)
    return {
        "counted_wrong": share(min(wrong, things), things),
        "lost": share(len(judged.lost), things),
        "double": share(min(len(judged.double), things), things),
        "kinds_right": share(right, len(fruit)),
        "known_called_unknown": share(sum(pair.reported["kind"] == UNKNOWN for pair in fruit), len(fruit)),
        "foreign_called_unknown": share(sum(pair.reported["kind"] == UNKNOWN for pair in foreign), len(foreign)),
        "volume_error": mean(np.abs(relative_errors(fruit))),
        "volume_bias": mean(relative_errors(fruit)),
        "volume_in_interval": share(covered(fruit), len(fruit)),
        "length_error_mm": mean(np.abs(size_errors_mm(fruit, "length"))),
        "diameter_error_mm": mean(np.abs(size_errors_mm(fruit, "diameter"))),
        "perimeter_error_mm": mean(np.abs(size_errors_mm(fruit, "perimeter"))),
    }


def pose_errors(poses: dict[str, Pose], simulation: Simulation) -> tuple[list[float], list[float]]:
    """Return (mean displacement over the belt that both see, mm; angle, degrees) of all but the reference."""
    rig = simulation.rig()
    displaced_mm, turned_deg = [], []
    for sensor, pose in poses.items():
        if sensor == rig.reference:
            continue
        common = _common_belt(simulation, sensor)
        metres, radians = pose.distance_to(simulation.truth.poses[sensor], common)
        displaced_mm.append(metres * 1e3)
        turned_deg.append(float(np.degrees(radians)))
    return displaced_mm, turned_deg


def _common_belt(simulation: Simulation, sensor: str) -> F64:
    """Return points (N, 3), in a sensor's optical frame, of the belt that it and the reference see."""
    import cv2

    rig = simulation.rig()
    here, there = (rig.footprint_m(one).astype(np.float32) for one in (sensor, rig.reference))
    _, common = cv2.intersectConvexConvex(cv2.convexHull(here), cv2.convexHull(there))
    corners = (here if common is None else common).reshape(-1, 2).astype(np.float64)
    low, high = corners.min(axis=0), corners.max(axis=0)
    grid = np.stack(np.meshgrid(*np.linspace(low, high, 9).T), axis=-1).reshape(-1, 2)
    outline = corners.reshape(-1, 1, 2).astype(np.float32)
    inside = [cv2.pointPolygonTest(outline, (float(x), float(y)), False) >= 0 for x, y in grid]
    flat = np.hstack([grid[inside], np.zeros((sum(inside), 1))])
    reference_m = rig.belt_frame().inverse().apply(flat)
    return simulation.truth.poses[sensor].inverse().apply(reference_m)
