"""`fruitgui.evaluation/1`: the product and the source's method on the same simulated belts, side by side."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from fruitgui.evaluation.chain import Acts, Chain, accuracy, pose_errors, run_chain
from fruitgui.evaluation.metrics import Metric, mean
from fruitgui.evaluation.paper import PaperRun, run_paper
from fruitgui.evaluation.scoring import score
from fruitgui.evaluation.stage import Act
from fruitgui.geometry.pose import Pose
from fruitgui.progress import Cancelled, Progress, never_cancelled, no_progress
from fruitgui.simulation.fruit import KINDS

SCHEMA = "fruitgui.evaluation/1"
TRAINING_FRUIT = 75
FOREIGN_SHARE = 0.1

PERCENT = {
    "counted_wrong", "lost", "double", "kinds_right", "known_called_unknown", "foreign_called_unknown",
    "volume_error", "volume_bias", "volume_in_interval",
}  # fmt: skip
"""Metrics that are shares."""


def acts_of(seed: int, fruit: int) -> Acts:
    """Return the three scenes of one evaluation: other fruit and other light in each, the rig the same."""
    return Acts(
        still=Act("still", 4 * seed + 1, seed, 15),
        training=Act("training", 4 * seed + 2, seed, TRAINING_FRUIT, speed_m_s=0.2),
        line=Act("line", 4 * seed + 3, seed, fruit, foreign=round(fruit * FOREIGN_SHARE), speed_m_s=0.1),
    )


def evaluate(
    seed: int, fruit: int, progress: Progress = no_progress, cancelled: Cancelled = never_cancelled
) -> dict[str, Any]:
    """Return product mode beside paper mode on `fruit` fruit that neither was trained on.

    Raises:
        CancelledByUserError: `cancelled` said so.
    """
    acts = acts_of(seed, fruit)
    with tempfile.TemporaryDirectory(prefix="fruitgui-evaluation-") as name:
        folder = Path(name)
        chain = run_chain(acts, folder, progress=lambda share, doing: progress(0.6 * share, doing), cancelled=cancelled)
        progress(0.6, "The source's method on the same recordings")
        paper = run_paper(acts, folder, cancelled)
    return {
        "schema": SCHEMA,
        "seed": seed,
        "calibration_refused": [reason.code for reason in chain.calibration.reasons],
        "product": _values(_product(chain, acts)),
        "paper": _values(_paper(paper, acts)),
    }


def _product(chain: Chain, acts: Acts) -> dict[str, Metric]:
    station = chain.calibration.station
    if station is None or chain.score is None or chain.report is None:
        return {}
    poses = {name: sensor.pose for name, sensor in station.sensors.items()}
    return {**_poses(poses, acts), **accuracy(chain.score, KINDS), **_speed(chain.report["timing"])}


def _paper(run: PaperRun, acts: Acts) -> dict[str, Metric]:
    judged = score(run.fruit, acts.line.simulation.truth)
    return {**_poses(run.poses, acts), **accuracy(judged, KINDS), **_speed(run.timing)}


def _speed(timing: Mapping[str, Any]) -> dict[str, Metric]:
    """Return how long perceiving and tracking one frame took, median."""
    return {"frame_ms": Metric(timing["frame_ms"]["p50"], None, None, timing["frames"])}


def _poses(poses: Mapping[str, Pose], acts: Acts) -> dict[str, Metric]:
    displaced_mm, turned_deg = pose_errors(dict(poses), acts.still.simulation)
    return {"pose_error_mm": mean(displaced_mm), "pose_error_deg": mean(turned_deg)}


def _values(metrics: Mapping[str, Metric]) -> dict[str, Any]:
    return {name: metric.to_dict() for name, metric in metrics.items()}


def table_lines(value: Mapping[str, Any]) -> list[str]:
    """Return the evaluation as a table for a person."""
    names = list(dict.fromkeys([*value["product"], *value["paper"]]))
    lines = [f"{'':<24}{'product':>32}{'paper':>32}"]
    for name in names:
        cells = [_cell(name, value[mode].get(name)) for mode in ("product", "paper")]
        lines.append(f"{name:<24}{cells[0]:>32}{cells[1]:>32}")
    return lines


def _cell(name: str, metric: Mapping[str, Any] | None) -> str:
    if metric is None or metric["value"] is None:
        return "–"
    factor, unit = (100.0, " %") if name in PERCENT else (1.0, "")
    text = f"{metric['value'] * factor:.2f}{unit}"
    if metric["low"] is not None:
        text += f" ({metric['low'] * factor:.2f}–{metric['high'] * factor:.2f})"
    return text
