"""The error study: registration of views held against poses that are known."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from fruitgui.progress import Progress, no_progress
from fruitgui.station.source import RecordingSource


def study_recording(source: RecordingSource, poses: Path, progress: Progress = no_progress) -> dict[str, Any]:
    """Return the study's report, `fruitgui.study/1`."""
    raise NotImplementedError


def summary_lines(value: Mapping[str, Any]) -> list[str]:
    """Return the study's figures as lines for a person."""
    lines = [f"{value['registered']} of {value['pairs']} ordered pairs of {value['views']} views were registered."]
    for mode in ("product", "paper"):
        rotation, translation = value[mode]["rotation_deg"], value[mode]["translation_mm"]
        lines.append(
            f"  {mode:<8} rotation {rotation['median']:.2f}° (p90 {rotation['p90']:.2f}°), "
            f"translation {translation['median']:.1f} mm (p90 {translation['p90']:.1f} mm)"
        )
    return lines
