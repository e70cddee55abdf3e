"""The error study: registration of views held against poses that are known."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from fruitgui.calibration.study import Closure, Component, Errors, LeftOut, study
from fruitgui.errors import InputError
from fruitgui.frame import Frame
from fruitgui.geometry.pose import Pose
from fruitgui.progress import Cancelled, Progress, never_cancelled, no_progress, stop_if
from fruitgui.sensors.recordings import Recording
from fruitgui.station.hands import Hands
from fruitgui.station.poses import KnownPose, read_poses
from fruitgui.station.source import RecordingSource

SCHEMA = "fruitgui.study/1"
NEAREST_FRAME_S = 0.5
"""A row whose nearest frame is farther off than this has none."""

MOST_VIEWS = 60
"""Views are registered in ordered pairs: sixty make 3540 of them."""


def study_recording(
    source: RecordingSource,
    poses: Path,
    progress: Progress = no_progress,
    cancelled: Cancelled = never_cancelled,
) -> dict[str, Any]:
    """Return the study's report, `fruitgui.study/1`.

    Raises:
        InputError: a file cannot be used, or fewer than two poses have a frame.
    """
    known = read_poses(poses)
    views, warnings = _views(source.open(), known, poses, cancelled)
    if len(views) < 2:
        raise InputError(
            "no_views", f"Fewer than two rows of {poses} have a frame in {source.path}.",
            "Check that poses and recording belong together.", file=poses,
        )  # fmt: skip
    if len(views) > MOST_VIEWS:
        warnings.append(f"Only {MOST_VIEWS} of {len(views)} views are used, evenly spread.")
        views = [views[at] for at in np.linspace(0, len(views) - 1, MOST_VIEWS).astype(int)]
    with Hands() as hands:
        result = study(views, progress, cancelled, hands)
    return {
        "schema": SCHEMA,
        "views": result.views,
        "pairs": result.pairs,
        "registered": result.registered,
        "product": _errors_value(result.product),
        "paper": _errors_value(result.paper),
        "closure": _closure_value(result.closure),
        "left_out": [_left_out_value(one) for one in result.left_out],
        "warnings": warnings,
    }


def _views(
    recording: Recording, known: Sequence[KnownPose], poses: Path, cancelled: Cancelled
) -> tuple[list[tuple[Frame, Pose]], list[str]]:
    """Return the frame nearest to each row, with its pose; a frame serves one row only."""
    nearest: dict[int, tuple[float, Frame]] = {}
    for _, frame in recording.frames():
        stop_if(cancelled)
        for at, row in enumerate(known):
            apart_s = abs(row.time_s - frame.time_s)
            if row.sensor == frame.sensor and apart_s <= min(NEAREST_FRAME_S, nearest.get(at, (math.inf,))[0]):
                nearest[at] = (apart_s, frame)
    warnings = [
        f"{poses}: line {row.line}: no frame of {row.sensor} at {row.time_s:.3f} s; the row is left out."
        for at, row in enumerate(known)
        if at not in nearest
    ]
    chosen = {(frame.sensor, frame.sequence): (frame, known[at].pose) for at, (_, frame) in nearest.items()}
    return list(chosen.values()), [*warnings[:20], *recording.warnings]


def _errors_value(errors: Errors | None) -> dict[str, Any] | None:
    if errors is None:
        return None
    return {
        "rotation_deg": _quantiles(np.degrees(errors.rotation_rad)),
        "translation_mm": _quantiles(errors.translation_m * 1e3),
        "components": {
            "R": [[_component(one) for one in row] for row in errors.R],
            "T_m": [_component(one) for one in errors.T_m],
        },
        "se3_covariance": errors.se3_covariance.tolist(),
    }


def _closure_value(closure: Closure | None) -> dict[str, Any] | None:
    if closure is None:
        return None
    return {
        "loops": len(closure.rotation_rad),
        "rotation_deg": _quantiles(np.degrees(closure.rotation_rad)),
        "translation_mm": _quantiles(closure.translation_m * 1e3),
    }


def _quantiles(values: np.ndarray[Any, np.dtype[np.float64]]) -> dict[str, float]:
    return {"median": float(np.median(values)), "p90": float(np.quantile(values, 0.9)), "worst": float(values.max())}


def _component(component: Component) -> dict[str, float]:
    return {"mean": component.mean, "std": component.std, "normal_p": component.normal_p}


def _left_out_value(left_out: LeftOut) -> dict[str, Any]:
    return {"source": left_out.source, "target": left_out.target, "reason": left_out.reason}


def summary_lines(value: Mapping[str, Any]) -> list[str]:
    """Return the study's figures as lines for a person."""
    lines = [f"{value['registered']} of {value['pairs']} ordered pairs of {value['views']} views were registered."]
    for mode, told in (("product", "product"), ("paper", "paper"), ("closure", "loops close")):
        if value[mode] is None:
            continue
        rotation, translation = value[mode]["rotation_deg"], value[mode]["translation_mm"]
        lines.append(
            f"  {told:<11} rotation {rotation['median']:.2f}° (p90 {rotation['p90']:.2f}°), "
            f"translation {translation['median']:.1f} mm (p90 {translation['p90']:.1f} mm)"
        )
    return lines
