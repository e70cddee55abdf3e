"""`fruitgui sensors`: what is connected, how well it runs, and what is wrong with it."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from fruitgui.cli.console import Console
from fruitgui.cli.options import Commands, add_json, finite
from fruitgui.errors import CancelledByUserError, InputError

LONGEST_S = 3600.0


def add(commands: Commands) -> None:
    """Add the command."""
    command = commands.add_parser("sensors", help="say what is connected, how well it runs, and what is wrong with it")
    command.add_argument("--seconds", default="3", metavar="N", help="how long sensors are watched; 0 runs none (3)")
    command.add_argument(
        "--install-udev-rules", action="store_true", help="let everybody on this computer use the sensors; asks first"
    )
    command.add_argument("--yes", action="store_true", help="do not ask before the rules are installed")
    command.add_argument(
        "--projectors", action="store_true",
        help="measure how long each projector takes to settle and who blinds whom, on a belt that stands; keep it",
    )  # fmt: skip
    command.add_argument(
        "--simulated", action="store_true", help="with --projectors: measure those of a simulated rig, to try it"
    )
    command.add_argument("--line", type=Path, metavar="FOLDER", help="where that is kept (the window's)")
    command.add_argument(
        "--root", type=Path, default=Path("/"), metavar="FOLDER",
        help="the system below this folder, for example a mounted image (/)",
    )  # fmt: skip
    add_json(command)
    command.set_defaults(run=run)


def run(options: argparse.Namespace, console: Console) -> int:
    """Check the sensors, or install the rules; what is wrong with a sensor is a result, not a failure."""
    if not options.root.is_dir():
        raise InputError("usage", f"{options.root} is not a folder.", "Name a folder.", file=options.root)
    if options.install_udev_rules:
        return _install(options.root, console, asked=options.yes)
    if options.projectors:
        from fruitgui.cli.projectors import measure_projectors, measure_simulated

        measure = measure_simulated if options.simulated else measure_projectors
        return measure(options.line, console)
    if options.simulated:
        raise InputError("usage", "--simulated goes with --projectors only.", "Add --projectors, or leave it out.")
    seconds = finite(options.seconds, "--seconds")
    if not 0.0 <= seconds <= LONGEST_S:
        raise InputError("usage", f"--seconds {seconds:g} is out of range.", f"Give 0 to {LONGEST_S:g} seconds.")
    return _check(options.root, seconds, console)


def _check(root: Path, seconds: float, console: Console) -> int:
    from fruitgui.cli.sensors_table import table_text
    from fruitgui.sensors.usb.machine import Machine
    from fruitgui.station.checkup.job import CheckupPlan, check_up

    checkup = check_up(CheckupPlan(seconds, Machine(root)), console.progress)
    console.result(checkup.value())
    if not console.as_json:
        console.say(table_text(checkup))
    return 0


def _install(root: Path, console: Console, *, asked: bool) -> int:
    """Install the rules, after a yes; nothing is changed where they are installed already."""
    from fruitgui.sensors.usb.machine import Machine
    from fruitgui.sensors.usb.udev import install_rules, rules_are_installed, rules_install

    machine = Machine(root)
    changed = not rules_are_installed(machine)
    install = rules_install(machine, "sudo")
    if changed:
        if not asked:
            _ask(f"{install.text}\nThis goes to {install.target}, so that everybody on this computer may use these "
                 f"sensors:\n\n    {install.shown()}\n\nInstall it? [y/N] ")  # fmt: skip
        install_rules(install)
    console.result({"rules": str(install.target), "changed": changed})
    said = "The rules are installed" if changed else "The rules are installed already"
    console.say(f"{said}: {install.target}\nUnplug the sensors and plug them in again.")
    return 0


def _ask(question: str) -> None:
    """Ask for a yes, on the terminal.

    Raises:
        InputError: nobody is there to answer.
        CancelledByUserError: it was not a yes.
    """
    if not sys.stdin.isatty():
        raise InputError("usage", "Nobody is here to say yes.", "Add --yes to install the rules without asking.")
    sys.stderr.write(question)
    sys.stderr.flush()
    if sys.stdin.readline().strip().lower() not in ("y", "yes"):
        raise CancelledByUserError
