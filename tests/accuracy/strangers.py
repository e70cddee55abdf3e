"""`python -m tests.accuracy.strangers --rigs ours second --seeds 901 902 --work FOLDER`: foreign things on lines.

Each seed is a station of its own: a training line of the five kinds, then a line of fruit with foreign things of
every shape among them, some of which touch fruit, in another light. Everything goes through the jobs of the command
line. Recordings stay in the folder, so another state of the code is measured on the same pictures.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections import defaultdict
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from fruitgui.classification.evidence import UNKNOWN
from fruitgui.classification.intervals import rate
from fruitgui.evaluation.scoring import score
from fruitgui.simulation import scenes
from fruitgui.simulation.fruit import KINDS
from fruitgui.simulation.labels import truth_labels
from fruitgui.simulation.labels import write_labels as write_own_labels
from fruitgui.simulation.simulation import Simulation
from fruitgui.station.record_simulated import record_simulation
from fruitgui.station.run_job import RunOptions, run_recording
from fruitgui.station.source import RecordingSource
from fruitgui.station.station import Station, StationSensor
from fruitgui.station.station_file import write_station as write_own_station
from fruitgui.station.train_job import train_recordings
from tests.second_rig.lines import LinePlan, line
from tests.second_rig.mcap_files import record
from tests.second_rig.scene import Scene
from tests.second_rig.scores import account
from tests.second_rig.truth_files import write_labels, write_station

OURS = (
    "hand", "leaf", "box", "cup", "stone", "potato", "orange", "pear", "mandarin",
    "bottle", "twig", "banana", "fingers", "sheet",
)  # fmt: skip
SECOND = (
    "hand", "leaf", "box", "orange", "potato", "bottle", "glove", "twig", "stone", "banana", "fingers", "sheet",
    "mandarin",
)  # fmt: skip
FLAT = ("leaf", "sheet", "twig")
"""Things that may lie lower than what depth tells from the belt."""

TRAINED = 60
FRUIT = 30
ROUNDS = 2
"""How often each foreign kind comes in a line."""


@dataclass(frozen=True, slots=True)
class Thing:
    """One thing that crossed the belt.

    Attributes:
        line: which line. kind: what it was. trained, touching: what the truth says of it.
        said: the kind in its record; None where it has none.
    """

    line: str
    kind: str
    trained: bool
    touching: bool
    said: str | None


@dataclass(frozen=True, slots=True)
class Crossing:
    """What a line was, and what the report said.

    Attributes:
        extra: (kind of the nearest thing, what it was said to be, ml) of each record that nothing has left for.
    """

    things: tuple[Thing, ...]
    extra: tuple[tuple[str, str, float], ...]


def main() -> int:
    """Measure and print."""
    parser = argparse.ArgumentParser(prog="python -m tests.accuracy.strangers")
    parser.add_argument("--rigs", nargs="+", choices=["ours", "second"], default=["ours", "second"])
    parser.add_argument("--seeds", nargs="+", type=int, default=[901])
    parser.add_argument("--work", type=Path, help="folder that keeps recordings between calls")
    options = parser.parse_args()
    folder = options.work or Path(tempfile.mkdtemp(prefix="strangers-"))
    folder.mkdir(parents=True, exist_ok=True)
    crossings = []
    for seed in options.seeds:
        for rig in options.rigs:
            crossing = LINES[rig](seed, folder)
            crossings.append(crossing)
            _say(f"-- {rig} {seed}: {_short(crossing)}")
    _say(table(crossings))
    return 0


def lux(seed: int) -> tuple[float, float]:
    """Return the light of the training day and of the line, log-uniform between 100 and 1000 lx."""
    first, second = np.exp(np.random.default_rng([seed, 8]).uniform(np.log(100.0), np.log(1000.0), 2)).tolist()
    return first, second


def ours(seed: int, folder: Path) -> Crossing:
    """Return a line of the product's own simulator."""
    taught, ran = lux(seed)
    training = scenes.line_scene(
        seed * 10 + 1, TRAINED, 0.25, rig_seed=seed, captures_hz=6.0, conditions=scenes.Conditions(lux=taught)
    )
    passing = scenes.line_scene(
        seed * 10 + 2, FRUIT, 0.2, 0.25, ROUNDS * len(OURS), rig_seed=seed, foreign_kinds=OURS, captures_hz=8.0,
        conditions=scenes.Conditions(lux=ran),
    )  # fmt: skip
    files = _Files(folder, f"ours-{seed}")
    for simulation, path in ((training, files.training), (passing, files.line)):
        if not path.exists():
            record_simulation(simulation, path)
    write_own_labels(files.labels, truth_labels(training, volume_share=1 / 3))
    _write_own_station(files.station, passing)
    report = files.report()
    judged = score(report["fruit"], passing.truth)
    said = {pair.true.fruit_id: str(pair.reported["kind"]) for pair in judged.pairs}
    things = tuple(
        Thing(f"ours {seed}", one.kind, one.kind in KINDS, one.touching, said.get(one.fruit_id))
        for one in passing.truth.fruit
    )
    near = [(_nearest(one, passing), one) for one in (*judged.double, *judged.phantom)]
    return Crossing(things, tuple((kind, str(one["kind"]), float(one["volume_ml"] or 0.0)) for kind, one in near))


def second(seed: int, folder: Path) -> Crossing:
    """Return a line of the second rig."""
    from tests.second_rig.produce import KINDS as TAUGHT

    taught, ran = lux(seed + 5000)
    plan = LinePlan(rig=seed, speed_m_s=0.25, light_lx=taught)
    training = line(seed * 10 + 1, replace(plan, fruit=TRAINED))
    passing = line(
        seed * 10 + 2,
        replace(plan, fruit=FRUIT, foreign=ROUNDS * len(SECOND), foreign_kinds=SECOND, touching=0.3, mingling=0.3,
                speed_m_s=0.2, light_lx=ran),
    )  # fmt: skip
    files = _Files(folder, f"second-{seed}")
    for scene, path in ((training, files.training), (passing, files.line)):
        if not path.exists():
            record(scene, path)
    write_labels(files.labels, training)
    write_station(files.station, training)
    report = files.report()
    found = account(passing, report)
    touching = _touching(passing)
    things = tuple(
        Thing(
            f"second {seed}", match.actor.thing.kind, match.actor.thing.kind in TAUGHT,
            match.actor.number in touching, None if match.said is None else str(match.said["kind"]),
        )
        for match in found.matches
    )  # fmt: skip
    extra = [("?", str(one["kind"]), float(one["volume_ml"] or 0.0)) for one in (*found.doubles, *found.ghosts)]
    return Crossing(things, tuple(extra))


LINES: dict[str, Callable[[int, Path], Crossing]] = {"ours": ours, "second": second}


@dataclass(frozen=True, slots=True)
class _Files:
    """Where a station's files lie."""

    folder: Path
    name: str

    @property
    def training(self) -> Path:
        return self.folder / f"{self.name}-training.mcap"

    @property
    def line(self) -> Path:
        return self.folder / f"{self.name}-line.mcap"

    @property
    def labels(self) -> Path:
        return self.folder / f"{self.name}-labels.csv"

    @property
    def station(self) -> Path:
        return self.folder / f"{self.name}-station.json"

    def report(self) -> dict[str, Any]:
        """Train and run."""
        model = self.folder / f"{self.name}.fruit"
        train_recordings([(RecordingSource(self.training), self.labels)], self.station, model)
        return run_recording(RecordingSource(self.line), self.station, RunOptions(model=model))


def _write_own_station(path: Path, simulation: Simulation) -> None:
    rig = simulation.rig()
    sensors = {
        sensor: StationSensor(simulation.device(sensor).serial, mount.pose, mount.surface)
        for sensor, mount in rig.mounts.items()
        if mount.surface is not None
    }
    write_own_station(path, Station(rig.reference, sensors))


def _nearest(reported: dict[str, Any], simulation: Simulation) -> str:
    """Return the kind of the thing that a record's path lies nearest to."""
    path = reported["path"]
    middle = path[len(path) // 2]
    truth = simulation.truth
    apart = {
        one: float(np.linalg.norm(middle["position_m"] - truth.position_m(one.fruit_id, middle["time_s"])))
        for one in truth.fruit
    }
    nearest = min(apart, key=lambda one: apart[one])
    return f"{nearest.kind} at {1e3 * apart[nearest]:.0f} mm"


def _touching(scene: Scene) -> set[int]:
    """Return the numbers of things that lie within a millimetre of another."""
    found: set[int] = set()
    for first, second in zip(scene.actors, scene.actors[1:], strict=False):
        surface = second.thing.body.surface_m @ second.rotation.T + second.origin_m
        inside = (surface - first.origin_m) @ first.rotation
        if float(first.thing.body.value(inside).min()) < 1e-3:
            found |= {first.number, second.number}
    return found


def _short(crossing: Crossing) -> str:
    things = crossing.things
    lost = [one.kind for one in things if one.said is None]
    passed = [f"{one.kind}→{one.said}" for one in things if not one.trained and one.said not in (None, UNKNOWN)]
    refused = [one.kind for one in things if one.trained and one.said == UNKNOWN]
    wrong = [f"{one.kind}→{one.said}" for one in things if one.trained and one.said not in (None, UNKNOWN, one.kind)]
    return f"lost {lost}; extra {list(crossing.extra)}; passed {passed}; refused {refused}; confused {wrong}"


def table(crossings: Sequence[Crossing]) -> str:
    """Return the figures of all lines with exact 95 % intervals, one a line."""
    things = [one for crossing in crossings for one in crossing.things]
    extra = [one for crossing in crossings for one in crossing.extra]
    fruit = [one for one in things if one.trained]
    strangers = [one for one in things if not one.trained]
    solid = [one for one in strangers if one.kind not in FLAT]
    rows = [_row("trained fruit called unknown", [one.said == UNKNOWN for one in _recorded(fruit)])]
    rows.append(_row("trained fruit of the right kind", [one.said == one.kind for one in _recorded(fruit)]))
    rows.append(_row("trained fruit without a record", [one.said is None for one in fruit]))
    for name, group in (("foreign", strangers), ("  alone", _apart(strangers)), ("  touching", _joined(strangers))):
        rows.append(_row(f"{name} called unknown", [one.said == UNKNOWN for one in _recorded(group)]))
    rows.append(_row("foreign without a record", [one.said is None for one in strangers]))
    rows.append(_row("  not flat, without a record", [one.said is None for one in solid]))
    rows.append(f"{'records too many':36s} {len(extra):4d} over {len(crossings)} lines, {len(things)} things")
    by_kind: dict[str, list[Thing]] = defaultdict(list)
    for one in strangers:
        by_kind[one.kind].append(one)
    for kind, group in sorted(by_kind.items()):
        missing = sum(one.said is None for one in group)
        known = sum(one.said not in (None, UNKNOWN) for one in group)
        rows.append(f"    {kind:16s} {len(group):4d} passed, {missing:3d} without a record, {known:3d} taken for fruit")
    return "\n".join(rows)


def _recorded(things: Iterable[Thing]) -> list[Thing]:
    return [one for one in things if one.said is not None]


def _apart(things: Iterable[Thing]) -> list[Thing]:
    return [one for one in things if not one.touching]


def _joined(things: Iterable[Thing]) -> list[Thing]:
    return [one for one in things if one.touching]


def _row(name: str, hits: Sequence[bool]) -> str:
    counted = rate(sum(hits), len(hits))
    return (
        f"{name:36s} {sum(hits):4d} of {counted.trials:4d}  {100 * counted.value:6.2f} %"
        f"  [{100 * counted.low:.2f}, {100 * counted.high:.2f}]"
    )


def _say(text: str) -> None:
    sys.stdout.write(text + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    raise SystemExit(main())
