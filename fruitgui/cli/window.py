"""`fruitgui` alone: the operator's window."""

from __future__ import annotations

import argparse
import gc
import os
import sys
from pathlib import Path

from fruitgui.cli.console import Console
from fruitgui.errors import InputError, WorldError


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add what the window takes."""
    parser.add_argument(
        "--folder", type=Path, metavar="FOLDER", help="where the line's files lie; the usual place unless given"
    )
    parser.set_defaults(run=run)


def run(options: argparse.Namespace, _console: Console) -> int:
    """Open the window and wait until it is closed.

    Raises:
        InputError: the folder is a file.
        WorldError: there is no screen, or the folder cannot be made.
    """
    if options.folder is not None and options.folder.exists() and not options.folder.is_dir():
        raise InputError("usage", f"{options.folder} is not a folder.", "Name a folder.", file=options.folder)
    if not has_screen():
        raise WorldError(
            "no_screen",
            "There is no screen to open the window on.",
            "Start it on a desktop, or use the commands that need none: see fruitgui --help.",
        )
    collected = gc.isenabled()
    gc.disable()  # a thousand modules are loaded, none to be collected; looking would take a fifth of a second
    try:
        from fruitgui.gui.app import run as open_window

        return open_window(options.folder)
    finally:
        if collected:
            gc.enable()


def has_screen() -> bool:
    """Tell whether Qt will find somewhere to show a window."""
    if not sys.platform.startswith("linux"):
        return True
    return any(os.environ.get(name) for name in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"))
