"""`fruitgui evaluate`: accuracy against simulated truth, product mode beside paper mode."""

from __future__ import annotations

import argparse
from pathlib import Path

from fruitgui.cli.console import Console
from fruitgui.cli.options import Commands, add_json, check_output
from fruitgui.errors import InputError


def add(commands: Commands) -> None:
    """Add the command."""
    command = commands.add_parser("evaluate", help="measure this program's own accuracy on simulated belts")
    command.add_argument("--seed", type=int, default=1, help="of the simulated scenes (1)")
    command.add_argument("--fruit", type=int, default=60, metavar="N", help="on the belt (60)")
    command.add_argument("--report", type=Path, required=True, metavar="OUT.json")
    add_json(command)
    command.set_defaults(run=run)


def run(options: argparse.Namespace, console: Console) -> int:
    """Evaluate and write the report."""
    from fruitgui.evaluation.evaluate import evaluate, table_lines
    from fruitgui.files import write_json

    if not 5 <= options.fruit <= 10_000:
        raise InputError("usage", f"--fruit {options.fruit} is out of range.", "Give 5 to 10000 fruit.")
    out = check_output(options.report)
    value = evaluate(options.seed, options.fruit, console.progress)
    write_json(out, value)
    console.result(value)
    for line in table_lines(value):
        console.say(line)
    return 0
