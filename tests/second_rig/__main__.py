"""`python -m tests.second_rig calibrate|line|hostile --seed N --cases … --work FOLDER`: the figures on this rig."""

from __future__ import annotations

import argparse
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

from tests.second_rig import calibrate_trials, line_trials
from tests.second_rig.lines import LinePlan
from tests.second_rig.product import ProductFailedError


def main() -> int:
    """Run the chosen trials and print tables."""
    options = _options()
    if options.what == "hostile":
        import pytest

        return int(pytest.main([str(Path(__file__).parents[1] / "journeys" / "test_hostile_input.py"), "-q"]))
    folder = options.work or Path(tempfile.mkdtemp(prefix="second-rig-"))
    folder.mkdir(parents=True, exist_ok=True)
    return _calibrate(options, folder) if options.what == "calibrate" else _line(options, folder)


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m tests.second_rig")
    parser.add_argument("what", choices=["calibrate", "line", "hostile"])
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--cases", default="", help="calibrate: how many placements; line: names, with commas")
    parser.add_argument("--work", type=Path, help="folder that keeps recordings between calls")
    parser.add_argument("--rig", type=int, default=0, help="line: which rig")
    parser.add_argument("--calibrated", action="store_true", help="line: with the poses that the product found itself")
    parser.add_argument("--grain", type=float, help="line: how strongly the belt's texture shows, 0 for not at all")
    parser.add_argument("--no-ill", action="store_true", help="calibrate: only the well-posed placements")
    return parser.parse_args()


def _say(text: str) -> None:
    sys.stdout.write(text + "\n")
    sys.stdout.flush()


def _calibrate(options: argparse.Namespace, folder: Path) -> int:
    trials = []
    for trial in calibrate_trials.battery(options.seed, int(options.cases or 40), folder, ill=not options.no_ill):
        _say(trial.line())
        if trial.verdict == "broken":
            _say(trial.outcome.stdout[-500:] + trial.outcome.stderr[-2500:])
        trials.append(trial)
    _say(calibrate_trials.summary(trials))
    return int(any(trial.verdict in ("broken", "wrong_pose", "accepted") for trial in trials))


def _line(options: argparse.Namespace, folder: Path) -> int:
    names = options.cases.split(",") if options.cases else list(line_trials.CASES)
    models: dict[bool, tuple[Path, Path]] = {}
    failed = 0
    for name in names:
        plan = replace(line_trials.CASES[name], rig=options.rig, grain=options.grain)
        biased = name == "biased"
        try:
            if biased not in models:
                label = f"{'biased' if biased else 'plain'}-{options.rig}"
                found = _found(plan, options, folder, label) if options.calibrated else None
                station, model, said = line_trials.train(plan, options.seed, folder, label, found)
                models[biased] = station, model
                _say(f"trained {label}: { {key: said[key] for key in list(said)[:12]} }"[:1500])
            _say(line_trials.table(line_trials.run(name, plan, options.seed, *models[biased], folder)))
        except ProductFailedError as error:
            failed += 1
            _say(f"== {name}: BROKEN {error}")
    return int(failed > 0)


def _found(plan: LinePlan, options: argparse.Namespace, folder: Path, label: str) -> Path:
    station, error = line_trials.calibrate(replace(plan, light_lx=400.0), options.seed, folder, label)
    _say(f"calibrated {label}: off by {error.shift_mm:.2f} mm, {error.angle_deg:.3f}°")
    return station


if __name__ == "__main__":
    raise SystemExit(main())
