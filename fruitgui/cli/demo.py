"""`fruitgui demo`: the whole way on the simulated rig, and how wrong it was."""

from __future__ import annotations

import argparse

from fruitgui.cli.console import Console
from fruitgui.cli.options import Commands, add_json, finite
from fruitgui.errors import InputError


def add(commands: Commands) -> None:
    """Add the command."""
    command = commands.add_parser("demo", help="calibrate, train and run on the simulated rig")
    command.add_argument("--headless", action="store_true", help="print a summary (there is no window yet)")
    command.add_argument("--seconds", default="40", metavar="N", help="of moving belt (40)")
    command.add_argument("--seed", type=int, default=1, help="of the simulated scene (1)")
    add_json(command)
    command.set_defaults(run=run)


def run(options: argparse.Namespace, console: Console) -> int:
    """Run the demo and print what was counted, measured, and how wrong it was."""
    from fruitgui.evaluation.demo import run_demo

    seconds = finite(options.seconds, "--seconds")
    if not 5.0 <= seconds <= 600.0:
        raise InputError("usage", f"--seconds {seconds:g} is out of range.", "Give 5 to 600 seconds.")
    outcome = run_demo(seconds, options.seed, console.progress)
    console.warn(outcome.warnings)
    console.result(outcome.value())
    for line in outcome.lines():
        console.say(line)
    return 0
