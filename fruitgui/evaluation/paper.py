"""The source's method from end to end on the recordings that the product ran on: the baseline.

Point-to-point ICP, K-Means splitting, the 32-value vector and its network,
closest-pair Kalman tracking of the mean of the seen points with the belt's
speed given, mirrored hulls. Nothing is refused and nothing is unknown.
"""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from fruitgui.calibration.calibrate import calibrate
from fruitgui.calibration.result import Calibration
from fruitgui.classification.evidence import Evidence, FeatureNames, LabelledFruit
from fruitgui.classification.paper import PaperModel, train_paper
from fruitgui.evaluation.scoring import score
from fruitgui.frame import F32
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rig import Mount, Rig
from fruitgui.measurement.paper import paper_size
from fruitgui.perception.limits import depth_limits
from fruitgui.perception.paper import PAPER_FEATURE_NAMES, KMeansSplitter, paper_view_features
from fruitgui.perception.perceiver import Perceiver
from fruitgui.perception.settings import PerceptionSettings
from fruitgui.progress import Cancelled, never_cancelled, stop_if
from fruitgui.sensors.recordings import open_recording
from fruitgui.station.calibrate_job import read_stills
from fruitgui.station.timing import Stopwatch
from fruitgui.tracking.belt import BeltMotion
from fruitgui.tracking.mode import paper_mode
from fruitgui.tracking.settings import TrackerSettings
from fruitgui.tracking.track import Track
from fruitgui.tracking.tracker import Tracker

if TYPE_CHECKING:
    from fruitgui.evaluation.chain import Acts
    from fruitgui.evaluation.stage import Act

NAMES = FeatureNames(PAPER_FEATURE_NAMES)
VIEWS_PER_FRUIT = 12
"""Views of a fruit that are described; the source's fifty samples of a kind came from fewer fruit."""


@dataclass(frozen=True, slots=True, eq=False)
class PaperRun:
    """What came of it.

    Attributes:
        poses: by sensor; empty where even the first guess was refused.
        fruit: as a report has them, without what the source does not measure.
        timing: of the line, as a report has it.
    """

    poses: Mapping[str, Pose]
    fruit: list[dict[str, Any]]
    timing: dict[str, Any]


def run_paper(acts: Acts, folder: Path, cancelled: Cancelled = never_cancelled) -> PaperRun:
    """Calibrate, train and run the source's way on the recordings of these acts.

    Raises:
        CancelledByUserError: `cancelled` said so.
    """
    calibration = calibrate(read_stills(open_recording(acts.still.path(folder))), with_paper=True, cancelled=cancelled)
    if not isinstance(calibration, Calibration):
        return PaperRun({}, [], Stopwatch().value())
    rig = _paper_rig(calibration)
    model = _train(acts.training, _tracks(acts.training, folder, rig, Stopwatch(), cancelled), rig)
    watch = Stopwatch()
    fruit = [_value(track, rig, model) for track in _tracks(acts.line, folder, rig, watch, cancelled)]
    return PaperRun(calibration.paper, fruit, watch.value())


def _paper_rig(calibration: Calibration) -> Rig:
    rig = calibration.rig
    mounts = {
        name: Mount(name, _with_covariance(calibration.paper.get(name, mount.pose), mount.pose), mount.surface,
                    mount.intrinsics)
        for name, mount in rig.mounts.items()
    }  # fmt: skip
    return Rig(rig.reference, mounts)


def _with_covariance(pose: Pose, ours: Pose) -> Pose:
    """Return the source's pose with the covariance that this station's calibration estimated (the default, 4.5)."""
    return Pose(pose.rotation, pose.translation_m, ours.covariance)


def _tracks(act: Act, folder: Path, rig: Rig, watch: Stopwatch, cancelled: Cancelled) -> list[Track]:
    velocity_m_s = act.simulation.truth.velocity_m_s(0.0)
    settings = TrackerSettings()
    tracker = Tracker(rig, BeltMotion(velocity_m_s), settings, paper_mode(settings))
    perceivers = _perceivers(rig)
    tracks: list[Track] = []
    for time_s, frame in open_recording(act.path(folder)).frames():
        stop_if(cancelled)
        began_s = time.perf_counter()
        tracks += tracker.update(perceivers[frame.sensor].observe(frame, time_s))
        watch.frame(time.perf_counter() - began_s)
    return tracks + tracker.finish()


def _perceivers(rig: Rig) -> dict[str, Perceiver]:
    settings = PerceptionSettings()
    return {
        name: Perceiver(
            name, mount.intrinsics, mount.surface, settings,
            KMeansSplitter(depth_limits(mount.intrinsics, mount.surface, settings), settings),
        )
        for name, mount in rig.mounts.items()
    }  # fmt: skip


def _train(act: Act, tracks: Sequence[Track], rig: Rig) -> PaperModel:
    """Train on the tracks whose kind the truth tells, as an operator would have labelled them."""
    truth = act.simulation.truth
    known = score([{"track": track, "path": _path(track)} for track in tracks], truth).pairs
    fruit = [
        LabelledFruit(str(pair.true.fruit_id), pair.true.kind, _evidence(pair.reported["track"], rig))
        for pair in known
        if not pair.true.foreign
    ]
    return train_paper(fruit, NAMES).model


def _evidence(track: Track, rig: Rig) -> Evidence:
    views = [sighting.view for sighting in track.sightings]
    chosen = [views[at] for at in np.unique(np.linspace(0, len(views) - 1, VIEWS_PER_FRUIT).astype(int))]
    features: F32 = np.stack([paper_view_features(view, rig.mounts[view.sensor].intrinsics) for view in chosen])
    return Evidence(features, np.zeros(0))


def _value(track: Track, rig: Rig, model: PaperModel) -> dict[str, Any]:
    size = paper_size(track, rig)
    vote = model.vote(_evidence(track, rig))
    return {
        "id": track.track,
        "kind": vote.kind,
        "kind_probability": vote.probability,
        "volume_ml": size.volume_m3.value * 1e6,
        "volume_std_ml": size.volume_m3.std * 1e6,
        "perimeter_mm": size.perimeter_m.value * 1e3,
        "path": _path(track),
    }


def _path(track: Track) -> list[dict[str, Any]]:
    return [{"time_s": point.time_s, "position_m": point.position_m.tolist()} for point in track.path]
