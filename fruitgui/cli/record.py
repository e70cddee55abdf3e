"""`fruitgui record`: frames of the sensors to a file, or what is sound of a cut file to a good one."""

from __future__ import annotations

import argparse
from pathlib import Path

from fruitgui.cli.console import Console
from fruitgui.cli.options import Commands, add_json, check_output, finite, names
from fruitgui.errors import InputError

LONGEST_S = 24 * 3600.0


def add(commands: Commands) -> None:
    """Add the command."""
    command = commands.add_parser("record", help="record the simulated rig, or recover a recording that was cut off")
    command.add_argument("--out", type=Path, required=True, metavar="R.mcap")
    command.add_argument("--seconds", default="10", metavar="N", help="how long (10)")
    command.add_argument("--sensors", metavar="ID,…", help="record only these")
    command.add_argument("--seed", type=int, default=1, help="of the simulated rig (1)")
    command.add_argument("--still", action="store_true", help="let the belt stand, as for calibrating")
    command.add_argument("--recover", type=Path, metavar="CUT.mcap", help="write what is sound of this file")
    add_json(command)
    command.set_defaults(run=run)


def run(options: argparse.Namespace, console: Console) -> int:
    """Record or recover."""
    from fruitgui.station.record_job import record_simulated, recover_recording

    out = check_output(options.out, [options.recover])
    if options.recover is not None:
        done = recover_recording(options.recover, out, console.progress)
    else:
        seconds = finite(options.seconds, "--seconds")
        if not 0.0 < seconds <= LONGEST_S:
            raise InputError("usage", f"--seconds {seconds:g} cannot be.", f"Give 0 to {LONGEST_S:g} seconds.")
        done = record_simulated(out, seconds, options.seed, names(options.sensors), options.still, console.progress)
    console.warn(done.warnings)
    console.result(done.value(out))
    console.say(done.line(out))
    return 0
