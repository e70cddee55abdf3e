"""From a still recording to a report, through the command line."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from fruitgui.cli import main
from fruitgui.evaluation.scoring import score
from fruitgui.sensors.recordings import RecordingWriter, open_recording
from tests.journeys.conftest import Stage

pytestmark = pytest.mark.xdist_group("stage")

NUMBERS = {
    "id", "kind_probability", "volume_ml", "volume_std_ml", "perimeter_mm", "perimeter_std_mm", "length_mm",
    "length_std_mm", "diameter_mm", "diameter_std_mm", "views", "first_seen_s", "last_seen_s",
}  # fmt: skip


def report_in(folder: Path) -> dict[str, Any]:
    return json.loads((folder / "report.json").read_text())


def test_a_line_is_counted_measured_and_named(run: Callable[..., int], stage: Stage, tmp_path: Path) -> None:
    assert run("--paper") == 0
    report = report_in(tmp_path)
    judged = score(report["fruit"], stage.line.simulation.truth)
    assert (judged.lost, judged.double, judged.phantom) == ((), (), ())
    fruit = [pair for pair in judged.pairs if not pair.true.foreign]
    assert sum(pair.reported["kind"] == pair.true.kind for pair in fruit) >= len(fruit) - 1
    errors = [abs(pair.reported["volume_ml"] / (pair.true.volume_m3 * 1e6) - 1) for pair in fruit]
    assert np.mean(errors) < 0.05
    assert all(pair.reported["volume_paper_ml"] > 0 for pair in fruit)


def test_the_report_is_as_the_contract_says(run: Callable[..., int], tmp_path: Path) -> None:
    assert run() == 0
    report = report_in(tmp_path)
    assert report["schema"] == "fruitgui.report/1"
    assert sum(report["counts"].values()) == len(report["fruit"])
    assert {"frames", "wall_s", "frame_ms", "stages_ms"} <= set(report["timing"])
    assert {sensor["id"] for sensor in report["sensors"]} == {"kinect_1", "kinect_2"}
    assert np.linalg.norm(report["belt"]["velocity_m_s"]) == pytest.approx(0.2, rel=0.005)
    for fruit in report["fruit"]:
        assert set(fruit) >= NUMBERS
        assert all(np.isfinite(fruit[name]) for name in NUMBERS)
        assert "volume_paper_ml" not in fruit
        times = [point["time_s"] for point in fruit["path"]]
        assert times == sorted(times)
        assert all(np.linalg.eigvalsh(np.array(point["covariance_m2"])).min() > 0 for point in fruit["path"])


def test_without_a_model_everything_is_counted_as_unknown(
    run: Callable[..., int], stage: Stage, tmp_path: Path
) -> None:
    assert run(model=False) == 0
    assert report_in(tmp_path)["counts"] == {"unknown": len(stage.line.simulation.truth.fruit)}


def test_a_model_that_knows_few_of_the_fruit_is_told_of_and_one_that_knows_them_is_not(
    stage: Stage, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    head, *lines = Path(stage.path("labels.csv")).read_text().splitlines()
    labels, model = tmp_path / "labels.csv", tmp_path / "lemons.fruit"
    labels.write_text("\n".join([head, *(line for line in lines if ",lemon," in line)]) + "\n")
    station, training = ["--station", stage.path("station.json")], stage.path("training.mcap")
    assert main(["train", training, "--labels", str(labels), *station, "--model", str(model)]) == 0
    said = []
    for used in (str(model), stage.path("model.fruit")):
        capsys.readouterr()
        report = tmp_path / "report.json"
        assert main(["run", training, *station, "--model", used, "--report", str(report)]) == 0
        said.append([one for one in report_in(tmp_path)["warnings"] if "unknown to the model" in one])
        assert all(one in capsys.readouterr().err for one in said[-1])
    assert [len(one) for one in said] == [1, 0]


def test_one_sensor_alone_counts_what_it_sees_and_the_other_is_missed_aloud(
    run: Callable[..., int], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("--sensors", "kinect_1") == 0
    report = report_in(tmp_path)
    assert any("kinect_2" in warning for warning in report["warnings"])
    assert "kinect_2" in capsys.readouterr().err
    assert len(report["fruit"]) >= 7


def test_a_sensor_that_falls_silent_and_an_offset_for_none_are_told(
    run: Callable[..., int], stage: Stage, tmp_path: Path
) -> None:
    source = open_recording(stage.path("line.mcap"))
    with RecordingWriter(stage.folder / "silent.mcap", source.sensors.values()) as writer:
        began_s = None
        for time_s, frame in source.frames():
            began_s = time_s if began_s is None else began_s
            if frame.sensor == "kinect_1" or time_s - began_s < 3.0:
                writer.write(frame)
    assert run("--clock-offset", "nobody=1", recording="silent.mcap") == 0
    warnings = report_in(tmp_path)["warnings"]
    assert any("kinect_2 gave no frames from" in warning for warning in warnings)
    assert any("nobody" in warning for warning in warnings)
    judged = score(report_in(tmp_path)["fruit"], stage.line.simulation.truth)
    assert (judged.lost, judged.double, judged.phantom) == ((), (), ())


def test_a_belt_speed_that_is_given_is_used(run: Callable[..., int], tmp_path: Path) -> None:
    assert run("--belt-speed", "0.2") == 0
    assert len(report_in(tmp_path)["fruit"]) == 9


def test_json_is_the_report_and_nothing_else(
    run: Callable[..., int], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("--json") == 0
    assert json.loads(capsys.readouterr().out) == report_in(tmp_path)


def test_clocks_that_disagree_are_put_right_by_the_fruit(
    run: Callable[..., int], stage: Stage, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    late_s = 0.35
    source = open_recording(stage.path("line.mcap"))
    with RecordingWriter(stage.folder / "late.mcap", source.sensors.values()) as writer:
        for time_s, frame in source.frames():
            shift_s = late_s if frame.sensor == "kinect_2" else 0.0
            writer.write(replace(frame, time_s=frame.time_s - shift_s), log_time_ns=round(time_s * 1e9))
    assert run(recording="late.mcap") == 0
    judged = score(report_in(tmp_path)["fruit"], stage.line.simulation.truth)
    assert (judged.lost, judged.double, judged.phantom) == ((), (), ())
    told = next(line for line in capsys.readouterr().err.splitlines() if "clock of sensor kinect_2" in line)
    assert float(told.split("off by ")[1].split(" s")[0]) == pytest.approx(late_s, abs=0.03)


def test_training_twice_gives_the_same_bytes(stage: Stage, tmp_path: Path) -> None:
    again = tmp_path / "again.fruit"
    arguments = ["train", stage.path("training.mcap"), "--labels", stage.path("labels.csv")]
    assert main([*arguments, "--station", stage.path("station.json"), "--model", str(again)]) == 0
    assert again.read_bytes() == Path(stage.path("model.fruit")).read_bytes()


def test_labels_that_match_nothing_are_named_by_line_and_the_rest_is_used(
    stage: Stage, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    lines = Path(stage.path("labels.csv")).read_text().splitlines()
    labels = tmp_path / "labels.csv"
    labels.write_text("\n".join([*lines, "kinect_1,9999,10,10,lemon,,f1", "ghost,1,10,10,lemon,,f1"]) + "\n")
    out = tmp_path / "model.fruit"
    arguments = ["train", stage.path("training.mcap"), "--labels", str(labels)]
    assert main([*arguments, "--station", stage.path("station.json"), "--model", str(out), "--json"]) == 0
    printed = capsys.readouterr()
    assert f"line {len(lines) + 1}" in printed.err
    assert f"line {len(lines) + 2}" in printed.err
    assert {one["kind"] for one in json.loads(printed.out)["kinds"]} >= {"lemon", "red_apple"}


def test_labels_of_which_none_matches_write_no_model(stage: Stage, tmp_path: Path) -> None:
    labels = tmp_path / "labels.csv"
    labels.write_text("sensor,time_s,u_px,v_px,kind,volume_ml\nkinect_1,9999,10,10,lemon,\n")
    out = tmp_path / "model.fruit"
    arguments = ["train", stage.path("training.mcap"), "--labels", str(labels)]
    assert main([*arguments, "--station", stage.path("station.json"), "--model", str(out)]) == 2
    assert not out.exists()


def test_a_bare_belt_is_refused_with_3_and_no_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    from fruitgui.simulation.scenes import bare_belt
    from fruitgui.station.record_simulated import record_simulation

    recording, station = tmp_path / "bare.mcap", tmp_path / "station.json"
    record_simulation(bare_belt(4), recording)
    assert main(["calibrate", str(recording), "--station", str(station), "--json"]) == 3
    value = json.loads(capsys.readouterr().out)
    assert value["accepted"] is False
    assert value["station"] is None
    assert {reason["code"] for reason in value["reasons"]} <= {"too_little_structure", "too_little_overlap"}
    assert not station.exists()


def test_a_cut_recording_is_used_as_far_as_it_is_sound(
    run: Callable[..., int], stage: Stage, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    whole = Path(stage.path("line.mcap")).read_bytes()
    cut = stage.folder / "cut.mcap"
    cut.write_bytes(whole[: int(0.6 * len(whole))])
    assert run(recording="cut.mcap") == 0
    assert "cut" in capsys.readouterr().err
    out = tmp_path / "recovered.mcap"
    assert main(["record", "--recover", str(cut), "--out", str(out)]) == 0
    assert out.exists()
