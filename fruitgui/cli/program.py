"""`fruitgui`: reads the arguments, runs one command, and turns every ending into an exit code."""

from __future__ import annotations

import argparse
import contextlib
import os
import sys
from collections.abc import Sequence
from typing import NoReturn

from fruitgui import __version__
from fruitgui.cli import calibrate, demo, evaluate, record, run, sensors, study, train, window
from fruitgui.cli.console import Console
from fruitgui.errors import CancelledByUserError, FruitguiError, InputError, WorldError
from fruitgui.heap import keep_few_heaps

COMMANDS = (demo, sensors, record, calibrate, train, run, study, evaluate)


class _Parser(argparse.ArgumentParser):
    """Raises what a person can read instead of leaving the process from inside."""

    def error(self, message: str) -> NoReturn:
        raise InputError("usage", f"{self.prog}: {message}", f"See {self.prog} --help.")


def parser() -> argparse.ArgumentParser:
    """Return the parser of the whole command line."""
    top = _Parser(
        prog="fruitgui",
        description="Measure, sort and count fruit on a belt with several RGB-D sensors.",
        epilog="Without a command: the window.",
    )
    window.add_options(top)
    top.add_argument("--version", action="version", version=f"fruitgui {__version__}")
    commands = top.add_subparsers(dest="command", metavar="COMMAND")
    for command in COMMANDS:
        command.add(commands)
    return top


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command; return its exit code (0, 1, 2, 3 or 130)."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    console = Console(as_json="--json" in given)
    try:
        return _told(given, console)
    except OSError as error:
        return _failed_outside(error, console)


def _told(given: list[str], console: Console) -> int:
    """Run one command and tell how it ended; return its exit code."""
    try:
        code = _run(given, console)
        sys.stdout.flush()
    except FruitguiError as error:
        console.error(error)
        return error.exit_code
    except KeyboardInterrupt:
        stopped = CancelledByUserError()
        console.error(stopped)
        return stopped.exit_code
    except MemoryError:
        full = WorldError("out_of_memory", "The machine has no memory left for this.", "Close other programs.")
        console.error(full)
        return full.exit_code
    return code


def _failed_outside(error: OSError, console: Console) -> int:
    """Say what the system refused, as far as anyone can still be told; return the exit code."""
    with contextlib.suppress(OSError):
        if not isinstance(error, BrokenPipeError):  # whoever read our output has gone and needs no reason
            what = f"The system refused: {error.strerror or error}."
            console.error(WorldError("system", what, "Check that the disk has room and is there.", file=error.filename))
    with contextlib.suppress(OSError):  # what is still unsaid must not fail once more at the very end
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return WorldError.exit_code


def _one_thread_per_matrix() -> None:
    """Keep small matrix products on one core: handing them to several takes longer than doing them.

    Takes effect because nothing has loaded numpy yet; what a person set stays.
    """
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
        os.environ.setdefault(name, "1")


def _run(given: list[str], console: Console) -> int:
    _one_thread_per_matrix()
    try:
        options = parser().parse_args(given)
    except SystemExit as done:  # --help and --version end here
        return int(done.code or 0)
    keep_few_heaps()
    code = options.run(options, console)
    return int(code)
