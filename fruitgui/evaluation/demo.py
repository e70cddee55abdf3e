"""The demonstration: the whole way on the simulated rig, in a minute, and how wrong it was."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from fruitgui.errors import WorldError
from fruitgui.evaluation.chain import Acts, Chain, accuracy, pose_errors, run_chain
from fruitgui.evaluation.metrics import Metric
from fruitgui.evaluation.stage import Act
from fruitgui.progress import Cancelled, Progress, never_cancelled, no_progress
from fruitgui.simulation.fruit import KINDS
from fruitgui.station.report import summary_lines

TRAINING_FRUIT = 50
TRAINING_SPEED_M_S = 0.2
LINE_SPEED_M_S = 0.1
FRUIT_PER_SECOND = 1.4
"""How many fruit cross in a second at that speed, 14 to the metre."""


@dataclass(frozen=True, slots=True, eq=False)
class DemoOutcome:
    """What the demonstration came to."""

    chain: Chain
    metrics: dict[str, Metric]
    pose_error_mm: float | None

    @property
    def warnings(self) -> tuple[str, ...]:
        """What a person should know."""
        return self.chain.warnings

    def value(self) -> dict[str, Any]:
        """Return the outcome as JSON."""
        return {
            "pose_error_mm": self.pose_error_mm,
            "metrics": {name: metric.to_dict() for name, metric in self.metrics.items()},
            "report": self.chain.report,
        }

    def lines(self) -> list[str]:
        """Return what to tell a person."""
        if self.chain.report is None or self.pose_error_mm is None:
            return ["The calibration was refused; try another --seed."]
        return [
            f"Sensors found each other: {self.pose_error_mm:.1f} mm off on the belt.",
            *summary_lines(self.chain.report),
            "Against the truth of the simulation:",
            *_told(self.metrics),
        ]


def _told(metrics: dict[str, Metric]) -> list[str]:
    lost, double, right = metrics["lost"], metrics["double"], metrics["kinds_right"]
    lines = [
        f"  lost {_count(lost)}, counted twice {_count(double)}, of {lost.n}",
        f"  kinds right {_count(right)} of {right.n}",
    ]
    for name, text, factor, unit in (
        ("volume_error", "volume off by", 100.0, " %"),
        ("length_error_mm", "length off by", 1.0, " mm"),
        ("diameter_error_mm", "diameter off by", 1.0, " mm"),
    ):
        value = metrics[name].value
        if value is not None:
            lines.append(f"  {text} {value * factor:.1f}{unit} on average")
    return lines


def _count(metric: Metric) -> int:
    return round((metric.value or 0.0) * metric.n)


def run_demo(
    seconds: float, seed: int, progress: Progress = no_progress, cancelled: Cancelled = never_cancelled
) -> DemoOutcome:
    """Calibrate, train and run on a simulated rig whose seed is given.

    Raises:
        WorldError: there is no room for the recordings.
    """
    fruit = max(5, round(seconds * FRUIT_PER_SECOND))
    acts = Acts(
        still=Act("still", seed + 1, seed, 15),
        training=Act("training", seed + 2, seed, TRAINING_FRUIT, speed_m_s=TRAINING_SPEED_M_S),
        line=Act("line", seed + 3, seed, fruit, speed_m_s=LINE_SPEED_M_S),
    )
    try:
        with tempfile.TemporaryDirectory(prefix="fruitgui-demo-") as folder:
            chain = run_chain(acts, Path(folder), progress=progress, cancelled=cancelled)
    except OSError as error:
        raise WorldError(
            "no_room", f"The demonstration cannot write its recordings: {error.strerror}.", "Free some disk space."
        ) from error
    metrics = {} if chain.score is None else accuracy(chain.score, KINDS)
    return DemoOutcome(chain, metrics, _pose_error_mm(chain, acts))


def _pose_error_mm(chain: Chain, acts: Acts) -> float | None:
    station = chain.calibration.station
    if station is None:
        return None
    poses = {name: sensor.pose for name, sensor in station.sensors.items()}
    return max(pose_errors(poses, acts.still.simulation)[0], default=0.0)
