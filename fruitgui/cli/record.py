"""`fruitgui record`: frames of the sensors to a file, or what is sound of a cut file to a good one."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from fruitgui.cli.console import Console
from fruitgui.cli.interrupts import ending_well
from fruitgui.cli.options import Commands, add_json, check_output, finite, names
from fruitgui.errors import CancelledByUserError, InputError, WorldError

if TYPE_CHECKING:
    from fruitgui.sensors.sensor import Sensor
    from fruitgui.sensors.turns import Schedule
    from fruitgui.station.record_state import Recorded, RecordPlan, RecordState

LONGEST_S = 24 * 3600.0
SIMULATED_S = 10.0
SMALLEST_PART_MB, SHORTEST_PART_S = 50.0, 5.0


def add(commands: Commands) -> None:
    """Add the command."""
    command = commands.add_parser(
        "record",
        help="record the sensors that are connected, or recover a recording that was cut off",
        description="Records every sensor that is connected, until the time is up or you press Ctrl-C; where none is, "
        "the simulated rig.",
    )
    command.add_argument("--out", type=Path, required=True, metavar="R.mcap")
    command.add_argument("--seconds", metavar="N", help="how long; until Ctrl-C unless given (simulated: 10)")
    command.add_argument("--sensors", metavar="ID,…", help="record only these")
    command.add_argument(
        "--station", type=Path, metavar="S.json",
        help="name the sensors as this station does, by their serials; as in the window unless given",
    )  # fmt: skip
    command.add_argument("--split-mb", metavar="MB", help="go on in another file, R_0002.mcap, before one is larger")
    command.add_argument("--split-seconds", metavar="S", help="go on in another file after so long")
    command.add_argument("--keep-free-mb", default="1000", metavar="MB", help="end before the disk has less (1000)")
    command.add_argument("--simulated", action="store_true", help="record the simulated rig, whatever is connected")
    command.add_argument("--seed", type=int, help="of the simulated rig (1)")
    command.add_argument("--still", action="store_true", help="simulated: let the belt stand, as for calibrating")
    command.add_argument("--recover", type=Path, metavar="CUT.mcap", help="write what is sound of this file")
    add_json(command)
    command.set_defaults(run=run)


def run(options: argparse.Namespace, console: Console) -> int:
    """Record or recover."""
    from fruitgui.station.recover_job import recover_recording

    out = check_output(options.out, [options.recover, options.station])
    if options.recover is not None:
        return _told(recover_recording(options.recover, out, console.progress), console)
    seconds = None if options.seconds is None else _within("--seconds", options.seconds, 0.0, LONGEST_S)
    if options.simulated or options.still or options.seed is not None:
        return _simulated(options, seconds, console)
    from fruitgui.station.devices import connected_devices, known_by_station, known_by_workspace, only, unusable_devices

    known = known_by_workspace() if options.station is None else known_by_station(options.station)
    console.warn(known.trouble)
    found, unusable = connected_devices(known.names), unusable_devices()
    if unusable and not found:
        model, why = unusable[0]
        raise WorldError("no_usable_sensor", f"A {model} is plugged in and cannot be used. {why.what}", why.remedy)
    console.warn(f"A {model} is left out. {why.what} {why.remedy}" for model, why in unusable)
    if not found:
        console.warn(["No sensor is connected: this records the simulated rig. See fruitgui record --help."])
        return _simulated(options, seconds, console)
    sensors = only(found, names(options.sensors))
    return _devices(sensors, known.schedule(sensors), _plan(options, out, seconds), console)


def _simulated(options: argparse.Namespace, seconds: float | None, console: Console) -> int:
    from fruitgui.station.record_simulated import record_simulated

    done = record_simulated(
        options.out, seconds or SIMULATED_S, 1 if options.seed is None else options.seed, names(options.sensors),
        options.still, console.progress,
    )  # fmt: skip
    return _told(done, console)


def _plan(options: argparse.Namespace, out: Path, seconds: float | None) -> RecordPlan:
    from fruitgui.sensors.recordings import Split
    from fruitgui.station.record_state import RecordPlan

    split_mb, split_s = options.split_mb, options.split_seconds
    split = Split(
        None if split_mb is None else round(1e6 * _within("--split-mb", split_mb, SMALLEST_PART_MB, 1e9)),
        None if split_s is None else _within("--split-seconds", split_s, SHORTEST_PART_S, LONGEST_S),
    )
    reserve_bytes = round(1e6 * _within("--keep-free-mb", options.keep_free_mb, 0.0, 1e9))
    return RecordPlan(out, seconds, split, reserve_bytes)


def _within(option: str, text: str, least: float, most: float) -> float:
    value = finite(text, option)
    if not least <= value <= most or (option == "--seconds" and value == 0.0):
        raise InputError("usage", f"{option} {value:g} cannot be.", f"Give {least:g} to {most:g}.")
    return value


def _devices(sensors: Sequence[Sensor], schedule: Schedule, plan: RecordPlan, console: Console) -> int:
    from fruitgui.station.record_job import record_sensors
    from fruitgui.station.record_state import Ending

    who = ", ".join(sensor.info.sensor for sensor in sensors)
    console.say(f"Recording {who}. Ctrl-C ends it, and keeps what was recorded.")
    with ending_well() as asked:
        done = record_sensors(sensors, schedule, plan, _Teller(console).watch, asked)
    code = _told(done, console)
    early = done.ended is Ending.STOPPED and plan.seconds is not None
    return CancelledByUserError.exit_code if early else code


class _Teller:
    """Says how far a recording is, and at once where a sensor fell silent or frames were lost."""

    def __init__(self, console: Console) -> None:
        self._console = console
        self._silent: tuple[str, ...] = ()
        self._losing = False

    def watch(self, state: RecordState) -> None:
        """Tell what is new."""
        for sensor in state.silent:
            if sensor not in self._silent:
                self._console.warn([f"{sensor} gives no frames since {state.seconds:.0f} s; the others go on."])
        for sensor in self._silent:
            if sensor not in state.silent:
                self._console.warn([f"{sensor} is back at {state.seconds:.0f} s."])
        self._silent = state.silent
        lost = sum(state.lost.values())
        if lost and not self._losing:
            self._losing = True
            self._console.warn(["Frames are being lost: this computer, or its disk, is too slow."])
        self._console.progress(state.share, self._line(state, lost))

    def _line(self, state: RecordState, lost: int) -> str:
        words = [
            f"{state.seconds:.0f} s",
            f"{sum(state.frames.values())} frames",
            f"{state.bytes_written / 1e6:.0f} MB",
        ]
        if state.parts > 1:
            words.append(f"part {state.parts}")
        if lost:
            words.append(f"{lost} lost")
        if state.room_s is not None:
            words.append(f"room for {state.room_s / 60:.0f} min")
        return ", ".join(words)


def _told(done: Recorded, console: Console) -> int:
    console.warn(done.warnings())
    console.result(done.value())
    console.say(done.line())
    return 0
