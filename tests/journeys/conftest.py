from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

from fruitgui.cli import main
from fruitgui.evaluation.stage import Act, record_acts
from fruitgui.simulation.labels import truth_labels, write_labels


@dataclass(frozen=True)
class Stage:
    """One rig's recordings, labels, station and model, made once."""

    folder: Path
    still: Act
    training: Act
    line: Act

    def path(self, name: str) -> str:
        return str(self.folder / name)


@pytest.fixture(scope="session")
def stage(tmp_path_factory: pytest.TempPathFactory) -> Stage:
    """Everything that the command line needs, by the command line where it has a command for it."""
    folder = tmp_path_factory.mktemp("stage")
    rig = 21
    stage = Stage(
        folder,
        Act("still", 1, rig, 15),
        Act("training", 2, rig, 25, speed_m_s=0.4),
        Act("line", 3, rig, 8, foreign=1, speed_m_s=0.2),
    )
    record_acts((stage.training, stage.line, stage.still), folder)
    write_labels(folder / "labels.csv", truth_labels(stage.training.simulation))
    station, model = stage.path("station.json"), stage.path("model.fruit")
    assert main(["calibrate", stage.path("still.mcap"), "--station", station]) == 0
    arguments = ["train", stage.path("training.mcap"), "--labels", stage.path("labels.csv")]
    assert main([*arguments, "--station", station, "--model", model]) == 0
    return stage


@pytest.fixture
def run(stage: Stage, tmp_path: Path) -> Callable[..., int]:
    """Run `fruitgui run` on the stage's line; the report goes to `report.json` in the test's folder."""

    def run_line(*more: str, recording: str = "line.mcap", model: bool = True) -> int:
        named = ["--model", stage.path("model.fruit")] if model else []
        arguments = ["run", stage.path(recording), "--station", stage.path("station.json"), *named, *more]
        return main([*arguments, "--report", str(tmp_path / "report.json")])

    return run_line
