"""The commands that say how good the product is: demo, evaluate and study, as a person starts them."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pytest

from fruitgui.cli import main
from tests.real_data import real_data
from tests.second_rig.arm import ArmPlan, record_arm

KITCHEN_VIEWS = 4


@pytest.mark.accuracy
def test_the_demo_counts_all_and_says_how_wrong_it_was(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["demo", "--headless", "--seconds", "6", "--seed", "3", "--json"]) == 0
    value = json.loads(capsys.readouterr().out)
    metrics = value["metrics"]
    assert metrics["lost"]["n"] >= 8
    assert (metrics["lost"]["value"], metrics["double"]["value"]) == (0, 0)
    # One of eight could be wrong by bad luck of eight views; two cannot.
    assert metrics["kinds_right"]["value"] >= 1 - 1.5 / metrics["kinds_right"]["n"]
    assert metrics["volume_error"]["value"] < 0.05
    assert value["pose_error_mm"] < 2.0
    assert sum(value["report"]["counts"].values()) >= metrics["lost"]["n"]


@pytest.mark.accuracy
def test_evaluate_prints_product_and_paper_with_intervals(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    report = tmp_path / "evaluation.json"
    assert main(["evaluate", "--seed", "4", "--fruit", "5", "--report", str(report)]) == 0
    printed = capsys.readouterr().out
    value = json.loads(report.read_text(encoding="utf-8"))
    assert value["schema"] == "fruitgui.evaluation/1"
    product, paper = value["product"], value["paper"]
    assert product.keys() == paper.keys()
    for name, metric in product.items():
        assert set(metric) >= {"value", "low", "high", "n"}, name
        assert name == "frame_ms" or metric["value"] is None or metric["low"] <= metric["value"] <= metric["high"], name
    assert product["volume_error"]["value"] < paper["volume_error"]["value"]
    assert product["lost"]["value"] == product["double"]["value"] == 0
    assert "product" in printed
    assert "paper" in printed


def kitchen_study(folder: Path) -> dict[str, Any]:
    poses, report = folder / "poses.csv", folder / "study.json"
    rows = real_data("kitchen_poses.csv").read_text(encoding="utf-8").splitlines()
    poses.write_text("\n".join(rows[: 1 + KITCHEN_VIEWS]) + "\n", encoding="utf-8")
    assert main(["study", str(real_data("kitchen_poses.mcap")), "--poses", str(poses), "--report", str(report)]) == 0
    return json.loads(report.read_text(encoding="utf-8"))


@pytest.mark.accuracy
@pytest.mark.real
def test_study_of_a_real_kinect_says_what_is_registrations_and_what_is_not(tmp_path: Path) -> None:
    value = kitchen_study(tmp_path)
    assert value["schema"] == "fruitgui.study/1"
    assert (value["views"], value["pairs"]) == (KITCHEN_VIEWS, KITCHEN_VIEWS * (KITCHEN_VIEWS - 1))
    assert value["registered"] + len(value["left_out"]) == value["pairs"]
    assert value["registered"] >= 6
    for mode in ("product", "paper"):
        assert len(value[mode]["components"]["R"]) == 3
        assert len(value[mode]["se3_covariance"]) == 6
    product, closure = value["product"], value["closure"]
    # Registrations agree among themselves several times better than with the poses that KinectFusion gave.
    assert closure["rotation_deg"]["median"] < 0.5
    assert closure["translation_mm"]["median"] < 15
    assert math.isfinite(product["rotation_deg"]["median"])
    assert product["rotation_deg"]["median"] < 3.0
    assert product["translation_mm"]["median"] < 80


@pytest.mark.accuracy
def test_views_from_an_arm_all_round_a_table_register_far_better_than_the_sources_way(tmp_path: Path) -> None:
    recording, poses = record_arm(31, ArmPlan(), tmp_path)
    report = tmp_path / "study.json"
    assert main(["study", str(recording), "--poses", str(poses), "--report", str(report)]) == 0
    value = json.loads(report.read_text(encoding="utf-8"))
    assert (value["views"], value["pairs"]) == (10, 90)
    assert value["registered"] + len(value["left_out"]) == 90
    assert value["registered"] >= 60
    product, paper = value["product"], value["paper"]
    # One capture of a Kinect holds a table with fruit and boxes to about a millimetre.
    assert product["rotation_deg"]["median"] < 0.12
    assert product["translation_mm"]["median"] < 2.0
    # A wrong hypothesis would be off by many centimetres and degrees; none may be accepted.
    assert product["rotation_deg"]["worst"] < 1.5
    assert product["translation_mm"]["worst"] < 25
    for figure in ("rotation_deg", "translation_mm"):
        assert product[figure]["median"] < 0.5 * paper[figure]["median"]
