"""`fruitgui sensors --projectors`: how long each projector takes to settle, and who blinds whom."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING

from fruitgui.calibration.projectors.settling import Refusal
from fruitgui.cli.console import Console
from fruitgui.errors import InputError
from fruitgui.progress import never_cancelled
from fruitgui.sensors.sensor import Sensor
from fruitgui.simulation.ahead import SimulatedRig
from fruitgui.station.devices import Known, connected_devices, known_by_workspace, named_by_serial
from fruitgui.station.projector_job import try_devices
from fruitgui.station.projectors import Projectors
from fruitgui.station.sources import PRESETS
from fruitgui.station.tried import Pair, Tried
from fruitgui.station.workspace import default_folder, open_workspace

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fruitgui.calibration.projectors.settling import Settled

REFUSED = 3
SIMULATED = "opposed_projectors"

REASONS = {
    Refusal.TOO_FEW: "too few pictures came. Check the cable, then measure again",
    Refusal.BLIND: "it sees nothing. Point it at the belt, keep the sun out, then measure again",
    Refusal.MOVED: "something moved meanwhile. Let the belt stand and nobody pass, then measure again",
    Refusal.UNSTEADY: "its light did not become steady. Let it warm up for ten minutes, then measure again",
}


def measure_projectors(line: Path | None, console: Console) -> int:
    """Measure, keep what was found in a line's folder, and say it; 3 where nothing could be told of any sensor.

    Args:
        line: the folder; the usual one unless given.
    """
    folder, known = _known(line, console)
    sensors = connected_devices(known.names)
    if not sensors:
        raise InputError(
            "no_turns", "No sensor is connected that takes turns.", "Plug them in; fruitgui sensors says what is wrong."
        )
    return _measure(folder, known, sensors, console)


def measure_simulated(line: Path | None, console: Console) -> int:
    """Do the same with a simulated rig over a belt that stands; see `measure_projectors`."""
    folder, known = _known(line, console)
    rig = SimulatedRig(PRESETS[SIMULATED])
    with rig.standing():
        return _measure(folder, known, named_by_serial(rig.sensors(), known.names), console)


def _known(line: Path | None, console: Console) -> tuple[Path, Known]:
    folder = default_folder() if line is None else line
    known = known_by_workspace(folder)
    console.warn(known.trouble)
    return folder, known


def _measure(folder: Path, known: Known, sensors: list[Sensor], console: Console) -> int:
    tried = try_devices(sensors, known.schedule(sensors), datetime.now(UTC), console.progress, never_cancelled)
    kept = _keep(folder, tried)
    console.result({**tried.value(), "kept": None if kept is None else str(kept)})
    for text in _lines(tried):
        console.say(text)
    if kept is None:
        return REFUSED
    console.say(f"Kept in {kept}; projectors take turns by it from now on.")
    return 0


def _keep(folder: Path, tried: Tried) -> Path | None:
    """Keep what was found beside what was known; return where, or None where there is nothing to keep."""
    if not tried.projectors.settlings:
        return None
    file = open_workspace(folder).projectors
    before = file.load().value or Projectors()
    file.save(before.renewed(tried.projectors))
    return file.path


def _lines(tried: Tried) -> Iterator[str]:
    for sensor, found in tried.alone.items():
        yield f"{sensor}: {_alone(found)}."
    for pair in tried.pairs:
        yield from _together(pair)


def _alone(found: Settled | Refusal) -> str:
    if isinstance(found, Refusal):
        return REASONS[found]
    return (
        f"steady after {found.settle_s:.2f} s, {found.discard_frames} pictures are left out, "
        f"{100.0 * found.steady.holes:.1f} % without depth (switched on {found.trials} times)"
    )


def _together(pair: Pair) -> Iterator[str]:
    if pair.seen is None:
        yield f"{' + '.join(pair.sensors)}: too few pictures came while both were on."
        return
    for sensor, other, seen in zip(pair.sensors, pair.sensors[::-1], pair.seen, strict=True):
        alone, both = 100.0 * seen.holes_alone, 100.0 * seen.holes_together
        yield (
            f"{sensor} beside {other}: without depth {alone:.1f} → {both:.1f} %, "
            f"noise {seen.noise_alone_mm:.1f} → {seen.noise_together_mm:.1f} mm: harm {seen.harm.value}."
        )
