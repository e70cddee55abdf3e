"""Trials of `fruitgui train` and `run`: lines whose every fruit is known."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from tests.second_rig.kinect import Noise
from tests.second_rig.lines import LinePlan, at_rest, line
from tests.second_rig.mcap_files import PLAIN, Style, record
from tests.second_rig.produce import KINDS
from tests.second_rig.product import Outcome, fruitgui, require
from tests.second_rig.scene import Scene
from tests.second_rig.scores import Account, PoseError, account, mean, measured, pose_errors, rate
from tests.second_rig.truth_files import write_labels, write_station

BIASED = (Noise(fattening_px=2.0, scale_error=0.006), Noise(fattening_px=2.0, scale_error=-0.006))
CASES = {
    "slow": LinePlan(),
    "fast": LinePlan(speed_m_s=0.4),
    "touching": LinePlan(touching=0.7, speed_m_s=0.15),
    "foreign": LinePlan(fruit=40, foreign=40, speed_m_s=0.2),
    "silent": LinePlan(silent_s=4.0, speed_m_s=0.2),
    "stopping": LinePlan(stop_s=4.0, speed_m_s=0.2),
    "offset": LinePlan(clock_s=0.8, speed_m_s=0.2),
    "dim": LinePlan(light_lx=100.0, speed_m_s=0.25),
    "bright": LinePlan(light_lx=1000.0, speed_m_s=0.25),
    "biased": LinePlan(noises=BIASED, speed_m_s=0.2),
    "rocking": LinePlan(rock_rad=0.06, speed_m_s=0.2),
}
"""Runs by name; "touching" makes every second fruit touch its neighbour with 70 %: about a third of pairs."""


@dataclass(frozen=True, slots=True)
class Trial:
    """One run against its truth."""

    name: str
    scene: Scene
    outcome: Outcome
    report: dict[str, Any]
    found: Account


def calibrate(plan: LinePlan, seed: int, folder: Path, name: str) -> tuple[Path, PoseError]:
    """Let the product find the rig by itself; return its station, and how wrong the other sensor's pose is."""
    scene = at_rest(seed, plan)
    recording = record(scene, folder / f"{name}-still-{seed}.mcap")
    station = folder / f"{name}-{seed}-station.json"
    require(fruitgui("calibrate", recording, "--station", station, "--reference", scene.eyes[0].name), 0)
    return station, pose_errors(scene, json.loads(station.read_text()))[0]


def train(plan: LinePlan, seed: int, folder: Path, name: str, station: Path | None = None
          ) -> tuple[Path, Path, dict[str, Any]]:  # fmt: skip
    """Record two training lines at different light, train on them; return station, model and what training said.

    Without a station the true one serves.
    """
    recordings, labels = [], []
    given, station = station is not None, station or folder / f"{name}-station.json"
    for n, light in enumerate((150.0, 800.0)):
        day = replace(plan, fruit=30, light_lx=light, touching=0.0, foreign=0, speed_m_s=0.25, silent_s=0.0, stop_s=0.0,
                      clock_s=0.0)  # fmt: skip
        scene = line(seed + 500 + n, day)
        recordings.append(record(scene, folder / f"{name}-train-{n}.mcap"))
        labels.append(write_labels(folder / f"{name}-train-{n}.csv", scene))
        if not given:
            write_station(station, scene)
    model = folder / f"{name}.model"
    said = require(fruitgui("train", *recordings, "--labels", *labels, "--station", station, "--model", model), 0)
    return station, model, said


def run(name: str, plan: LinePlan, seed: int, station: Path, model: Path | None, folder: Path,
        extra: Sequence[str] = (), style: Style = PLAIN) -> Trial:  # fmt: skip
    """Record a line and run the product on it."""
    scene = line(seed, plan)
    recording = record(scene, folder / f"{name}-{seed}.mcap", style)
    report = folder / f"{name}-{seed}.report.json"
    report.unlink(missing_ok=True)
    options = ["--model", model] if model else []
    outcome = fruitgui("run", recording, "--station", station, *options, "--report", report, *extra)
    require(outcome, 0)
    said = json.loads(report.read_text())
    return Trial(name, scene, outcome, said, account(scene, said))


def table(trial: Trial) -> str:
    """Return a run's figures, one a line, with 95 % intervals."""
    found = trial.found
    rows = measured(found)
    strangers = [m for m in found.matches if m.said is not None and m.actor.thing.kind not in KINDS]
    missing = [actor.thing.kind for actor in found.lost]
    timing = trial.report.get("timing", {})
    lines = [
        f"== {trial.name}: {len(found.matches)} things, {len(trial.report['fruit'])} records;"
        f" lost {len(missing)} {missing or ''} double {len(found.doubles)} ghost {len(found.ghosts)};"
        f" {timing.get('frames', 0) / max(trial.outcome.wall_s, 1e-9):.0f}"
        f" frames/s wall, cpu {trial.outcome.cpu_s:.1f} s, {trial.outcome.peak_mb:.0f} MB",
    ]
    figures = [
        ("kinds right", rate(bool(r["right"]) for r in rows)),
        ("trained called unknown", rate(bool(r["unknown"]) for r in rows)),
        ("foreign called unknown", rate(m.said["kind"] == "unknown" for m in strangers if m.said)),
        ("volume |error|, %", mean([100 * abs(float(r["volume"])) for r in rows if "volume" in r])),
        ("volume bias, %", mean([100 * float(r["volume"]) for r in rows if "volume" in r])),
        ("volume 95 % intervals hold", rate(bool(r["held"]) for r in rows if "held" in r)),
    ]
    for size in ("length", "diameter"):
        figures.append((f"{size} |error|, mm", mean([abs(float(r[size])) for r in rows if size in r])))
        figures.append((f"{size} bias, mm", mean([float(r[size]) for r in rows if size in r])))
    for kind in KINDS:
        own = [100 * abs(float(r["volume"])) for r in rows if r["kind"] == kind and "volume" in r]
        figures.append((f"volume |error| {kind}, %", mean(own)))
    lines += [f"   {name:38s} {v:8.3f}  [{low:.3f}, {high:.3f}]  n={n}" for name, (v, low, high, n) in figures if n]
    wrong = [f"{r['number']}:{r['kind']}→{r['said']}" for r in rows if not r["right"]]
    wrong += [
        f"{m.actor.number}:{m.actor.thing.kind}→{m.said['kind']}"
        for m in strangers
        if m.said and m.said["kind"] != "unknown"
    ]
    return "\n".join([*lines, *([f"   wrong: {' '.join(wrong)}"] if wrong else [])])
