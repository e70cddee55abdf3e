"""`fruitgui calibrate`: the sensors of a still recording find each other and the belt."""

from __future__ import annotations

import argparse
from pathlib import Path

from fruitgui.cli.console import Console
from fruitgui.cli.options import Commands, add_json, add_recording_options, check_output, source

REFUSED = 3


def add(commands: Commands) -> None:
    """Add the command."""
    command = commands.add_parser("calibrate", help="let the sensors of a still scene find each other and the belt")
    command.add_argument("recording", type=Path, help="a recording of a still scene with fruit on the belt")
    command.add_argument("--station", type=Path, required=True, metavar="OUT.json", help="the station file to write")
    command.add_argument("--reference", metavar="S", help="the sensor whose frame of reference is used")
    command.add_argument(
        "--depths", type=Path, metavar="D.json", help="depth corrections of the devices, as a line's folder keeps them"
    )
    add_recording_options(command)
    add_json(command)
    command.set_defaults(run=run)


def run(options: argparse.Namespace, console: Console) -> int:
    """Calibrate; 0 with a station written, or 3 with the reasons and no file."""
    from fruitgui.station.calibrate_job import calibrate_recording
    from fruitgui.station.depths import DeviceDepths
    from fruitgui.station.written import read_written

    out = check_output(options.station, [options.recording])
    depths = None if options.depths is None else read_written(options.depths, DeviceDepths)
    outcome = calibrate_recording(
        source(options, options.recording), options.reference, out, console.progress, depths=depths
    )
    console.warn(outcome.warnings)
    console.result(outcome.value(out))
    for line in outcome.lines(out):
        console.say(line)
    if not outcome.accepted:
        console.refused(outcome.reasons)
        return REFUSED
    return 0
