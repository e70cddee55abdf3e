"""`python -m fruitgui.gui.benchmark`: how quick the window is while the line runs flat out beside it.

The line is a simulated one with two sensors, recorded, and played over and over as fast as the line can follow. Blocks
are how much later than it should a timer comes on the window's thread: what a key or a touch had to wait. Without a
screen (`QT_QPA_PLATFORM=offscreen`, the default) everything is painted all the same, into memory.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np

OPENINGS = 5


def main() -> int:
    """Time the window and print the figures."""
    wanted = _parser().parse_args()
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    for line in figures(wanted.folder, wanted.minutes, wanted.blame):
        sys.stdout.write(line + "\n")
        sys.stdout.flush()
    return 0


def figures(folder: Path | None, minutes: float, blame_ms: float | None) -> Iterator[str]:
    """Set the line up where it is not, and give one line for each figure."""
    from fruitgui.gui.app import make_qt
    from fruitgui.gui.benchmark.opening import opened_and_closed
    from fruitgui.gui.benchmark.run import Run
    from fruitgui.gui.benchmark.stage import stage_in

    with stage_in(folder) as made:
        openings = [opened_and_closed(made) for _ in range(OPENINGS)]
        for name, took_s in (
            ("from the start of the process to the window", [one.open_s for one in openings]),
            ("closing at once", [one.close_s for one in openings]),
        ):
            yield f"{name}: {np.median(took_s):.2f} s (median of {OPENINGS}; longest {max(took_s):.2f} s)"
        yield from Run(make_qt(), made).figures(minutes, blame_ms)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m fruitgui.gui.benchmark", description=__doc__)
    parser.add_argument("--minutes", type=float, default=3.0, help="that the line runs (3)")
    parser.add_argument("--folder", type=Path, help="where the line is set up, or is already; a new one unless given")
    parser.add_argument("--blame", type=float, metavar="MS", help="say where the window's thread was when it was late")
    return parser


if __name__ == "__main__":
    sys.exit(main())
