"""`fruitgui demo`: the whole way on the simulated rig, in the window or as a summary."""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path

from fruitgui.cli.console import Console
from fruitgui.cli.options import Commands, add_json, finite
from fruitgui.cli.window import has_screen
from fruitgui.errors import InputError


def add(commands: Commands) -> None:
    """Add the command."""
    command = commands.add_parser("demo", help="calibrate and train on the simulated rig, and run it in the window")
    command.add_argument(
        "--headless", action="store_true", help="print what was counted, and how wrong it was, instead of a window"
    )
    command.add_argument("--seconds", default="40", metavar="N", help="of moving belt, without the window (40)")
    command.add_argument("--seed", type=int, default=1, help="of the simulated scene (1)")
    add_json(command)
    command.set_defaults(run=run)


def run(options: argparse.Namespace, console: Console) -> int:
    """Run the demo in the window, or, where there is no screen, print what was counted and how wrong it was."""
    seconds = finite(options.seconds, "--seconds")
    if not 5.0 <= seconds <= 600.0:
        raise InputError("usage", f"--seconds {seconds:g} is out of range.", "Give 5 to 600 seconds.")
    if options.headless or options.json:
        return _summary(seconds, options.seed, console)
    if not has_screen():
        console.say("There is no screen here: this is the summary that --headless prints.")
        return _summary(seconds, options.seed, console)
    return _window(options.seed, console)


def _summary(seconds: float, seed: int, console: Console) -> int:
    from fruitgui.evaluation.demo import run_demo

    outcome = run_demo(seconds, seed, console.progress)
    console.warn(outcome.warnings)
    console.result(outcome.value())
    for line in outcome.lines():
        console.say(line)
    return 0


def _window(seed: int, console: Console) -> int:
    """Set a line up in a folder that lasts as long as the window, and open it."""
    from fruitgui.evaluation.demo_line import set_up_line
    from fruitgui.gui.app import run as open_window
    from fruitgui.station.workspace import open_workspace

    with tempfile.TemporaryDirectory(prefix="fruitgui-demo-") as name:
        folder = Path(name) / "demo_line"
        console.say("Setting up a simulated line: about a minute.")
        set_up_line(open_workspace(folder), seed, console.progress)
        return open_window(folder)
