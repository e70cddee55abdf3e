"""`python -m fruitgui.gui.benchmark`: how quick the window is while the line runs flat out beside it.

The line is a simulated one with two sensors, recorded, and played over and over as fast as the line can follow. Blocks
are how much later than it should a timer comes on the window's thread: what a key or a touch had to wait. Without a
screen (`QT_QPA_PLATFORM=offscreen`, the default) everything is painted all the same, into memory.

What is asked holds on two free cores. Beside each block stands what the window's thread itself worked in one go: on a
busy machine that tells what is the window's own fault. The exit code is 0 however quick the machine is.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from fruitgui.gui.benchmark.figure import Figure

OPENINGS = 5
OPEN_S = 2.0


def main() -> int:
    """Time the window and print the figures."""
    from fruitgui.gui.benchmark.figure import head
    from fruitgui.heap import keep_few_heaps

    keep_few_heaps()
    wanted = _parser().parse_args()
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    _tell(head())
    missed = 0
    for figure in figures(wanted.folder, wanted.minutes, wanted.blame):
        missed += figure.met is False
        _tell(figure.line())
    _tell(f"{missed} not as asked" if missed else "all as asked")
    return 0


def figures(folder: Path | None, minutes: float, blame_ms: float | None) -> Iterator[Figure]:
    """Set the line up where it is not, and give one figure after the other."""
    from fruitgui.gui.app import make_qt
    from fruitgui.gui.benchmark.figure import Figure
    from fruitgui.gui.benchmark.opening import openings
    from fruitgui.gui.benchmark.run import Run
    from fruitgui.gui.benchmark.stage import stage_in

    with stage_in(folder) as made:
        timed = openings(made, OPENINGS)
        open_s, work_s, close_s = ([getattr(one, name) for one in timed] for name in ("open_s", "work_s", "close_s"))
        median_s = float(np.median(open_s))
        more = f"median of {OPENINGS}, longest {max(open_s):.2f} s; own work {np.median(work_s):.2f} s"
        yield Figure("window is there", f"{median_s:.2f} s", f"<= {OPEN_S:.0f} s", median_s <= OPEN_S, more)
        yield Figure("closing at once", f"{np.median(close_s):.2f} s", more=f"longest {max(close_s):.2f} s")
        yield from Run(make_qt(), made).figures(minutes, blame_ms)


def _tell(line: str) -> None:
    sys.stdout.write(line + "\n")
    sys.stdout.flush()


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m fruitgui.gui.benchmark", description=__doc__)
    parser.add_argument("--minutes", type=float, default=3.0, help="that the line runs (3)")
    parser.add_argument("--folder", type=Path, help="where the line is set up, or is already; a new one unless given")
    parser.add_argument("--blame", type=float, metavar="MS", help="say where the window's thread was when it was late")
    return parser


if __name__ == "__main__":
    sys.exit(main())
