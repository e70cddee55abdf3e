# ruff: noqa: ANN401 — choices are passed on as they are
"""Trials of `fruitgui calibrate`: placements that must be posed right, and scenes that must be refused."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tests.second_rig.camera import LENSES
from tests.second_rig.kinect import Noise
from tests.second_rig.mcap_files import PLAIN, Style, record
from tests.second_rig.product import Outcome, fruitgui
from tests.second_rig.scene import Scene
from tests.second_rig.scores import PoseError, mean, pose_errors, rate
from tests.second_rig.stills import ILL_POSED, LAYOUTS, ill_posed, still

SHIFT_LIMIT_MM, ANGLE_LIMIT_DEG = 2.0, 0.1


@dataclass(frozen=True, slots=True)
class Trial:
    """One scene, what the product said of it and how wrong that was.

    Attributes:
        errors: of every pair with a shared view; empty where it refused or broke.
        verdict: ok, wrong_pose, refused, wrong_code, accepted, or broken.
    """

    name: str
    verdict: str
    outcome: Outcome
    errors: tuple[PoseError, ...]
    codes: tuple[str, ...]

    @property
    def worst_mm(self) -> float:
        """Largest displacement among the pairs."""
        return max((error.shift_mm for error in self.errors), default=0.0)

    @property
    def worst_deg(self) -> float:
        """Largest angle among the pairs."""
        return max((error.angle_deg for error in self.errors), default=0.0)

    def line(self) -> str:
        """Return one row of the table."""
        said = ",".join(self.codes) or "-"
        return (f"{self.name:24s} {self.verdict:11s} exit {self.outcome.code} {self.worst_mm:7.2f} mm "
                f"{self.worst_deg:6.3f}° {self.outcome.cpu_s:6.1f} s "
                f"{self.outcome.peak_mb:5.0f} MB {said}")  # fmt: skip


def posed(seed: int, layout: str, folder: Path, style: Style = PLAIN, **choices: Any) -> Trial:
    """Run one well-posed scene."""
    scene = still(seed, layout, **choices)
    return _judge(f"{layout}-{seed}", scene, folder, style, ())


def refused(seed: int, case: str, folder: Path) -> Trial:
    """Run one ill-posed scene."""
    return _judge(f"{case}-{seed}", ill_posed(seed, case), folder, Style(), ILL_POSED[case])


def _judge(name: str, scene: Scene, folder: Path, style: Style, wanted: tuple[str, ...]) -> Trial:
    recording = record(scene, folder / f"{name}.mcap", style)
    station = folder / f"{name}.json"
    station.unlink(missing_ok=True)
    outcome = fruitgui("calibrate", recording, "--station", station, "--reference", scene.eyes[0].name)
    codes = tuple(reason["code"] for reason in (outcome.value or {}).get("reasons", ()))
    broken = outcome.value is None or outcome.code not in (0, 3) or station.exists() != (outcome.code == 0)
    if broken:
        return Trial(name, "broken", outcome, (), codes)
    if outcome.code == 3:
        right = not wanted or bool(set(codes) & set(wanted))
        return Trial(name, ("ok" if wanted else "refused") if right else "wrong_code", outcome, (), codes)
    errors = tuple(pose_errors(scene, json.loads(station.read_text())))
    wrong = any(e.shift_mm > SHIFT_LIMIT_MM or e.angle_deg > ANGLE_LIMIT_DEG for e in errors)
    # An ill-posed scene may be accepted where the poses are right all the same, but for one that moved.
    settled = not wanted or (not wrong and bool(errors) and "scene_moved" not in wanted)
    verdict = "wrong_pose" if wrong else "ok" if settled else "accepted"
    return Trial(name, verdict, outcome, errors, codes)


def battery(seed: int, cases: int, folder: Path, *, ill: bool = True) -> Iterator[Trial]:
    """Run `cases` well-posed placements (layouts, lenses and noise in turn), then two of every ill-posed case."""
    noises = (Noise(), Noise(fattening_px=1.0), Noise(standing_share=0.6, projector_side=1.0), Noise(sigma=1.8e-3))
    lenses = ("640x480", "640x480", "848x480", "640x480", "1280x720", "640x480", "320x240", "640x480")
    styles = (
        Style(),
        Style("png", "png"),
        Style("bgr8", "32FC1", chunk="lz4"),
        Style("rgb8", "compressedDepth", padded=True),
    )
    for n in range(cases):
        yield posed(seed + n, LAYOUTS[n % len(LAYOUTS)], folder, styles[n // 4 % 4], captures=8 if n % 3 else 4,
                    noise=noises[n // 2 % 4], lens=LENSES[lenses[n % 8]])  # fmt: skip
    for n in range(2 if ill else 0):
        for case in ILL_POSED:
            yield refused(seed + n, case, folder)


def summary(trials: list[Trial]) -> str:
    """Return the figures over all trials."""
    well = [t for t in trials if t.name.split("-")[0] in LAYOUTS]
    ill = [t for t in trials if t not in well]
    accepted = [t for t in well if t.errors]
    rows = [
        ("accepted of well-posed", rate(bool(t.errors) for t in well)),
        ("of these within 2 mm, 0.1°", rate(t.verdict == "ok" for t in accepted)),
        ("pose error, mm (worst pair)", mean([t.worst_mm for t in accepted])),
        ("pose error, ° (worst pair)", mean([t.worst_deg for t in accepted])),
        ("ill-posed handled rightly", rate(t.verdict == "ok" for t in ill)),
        ("processor time, s", mean([t.outcome.cpu_s for t in trials])),
    ]
    return "\n".join(f"{name:30s} {v:8.3f}  [{low:.3f}, {high:.3f}]  n={n}" for name, (v, low, high, n) in rows)
