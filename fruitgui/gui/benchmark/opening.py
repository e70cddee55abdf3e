"""From nothing to a window: a process of its own, timed from outside."""

from __future__ import annotations

import gc
import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtCore import QCoreApplication, QEvent, QObject, QTimer
from PySide6.QtWidgets import QMainWindow

SHOWN = "shown"
END_S = 30.0


@dataclass(frozen=True, slots=True)
class Opening:
    """One start and one end.

    Attributes:
        open_s: until the first painting.
        work_s: what the process itself worked until then; the rest it waited for a core or for the disk.
        close_s: from the interrupt until it was gone.
    """

    open_s: float
    work_s: float
    close_s: float


class FirstPaint(QObject):
    """Says on standard output when the window is painted for the first time."""

    def __init__(self, qt: QCoreApplication) -> None:
        super().__init__(qt)
        self._qt = qt
        qt.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        """Wait for it; it is said once the painting is done."""
        if event.type() == QEvent.Type.Paint and isinstance(watched, QMainWindow):
            self._qt.removeEventFilter(self)
            QTimer.singleShot(0, self, self._say)
        return False

    def _say(self) -> None:
        sys.stdout.write(f"{SHOWN} {time.process_time()}\n")
        sys.stdout.flush()


def openings(folder: Path, count: int) -> list[Opening]:
    """Open the window on a folder and close it again, so many times.

    It is opened once more before, so that Python has compiled all that it loads: so it is where it was installed.
    """
    with tempfile.TemporaryDirectory(prefix="fruitgui-compiled-") as compiled:
        environment = {**os.environ, "PYTHONPYCACHEPREFIX": compiled}
        environment.pop("PYTHONDONTWRITEBYTECODE", None)
        return [opened_and_closed(folder, environment) for _ in range(count + 1)][1:]


def opened_and_closed(folder: Path, environment: Mapping[str, str]) -> Opening:
    """Open the window on a folder in a new process, and end it once it is seen."""
    began_s = time.perf_counter()
    command = [sys.executable, "-m", "fruitgui.gui.benchmark.opening", str(folder)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as process:  # noqa: S603
        assert process.stdout is not None  # noqa: S101 - asked for
        said = process.stdout.readline().split()
        shown_s = time.perf_counter()
        process.send_signal(signal.SIGINT)
        process.wait(END_S)
    if said[:1] != [SHOWN]:
        raise RuntimeError("the window was not seen")
    return Opening(shown_s - began_s, float(said[1]), time.perf_counter() - shown_s)


def _opened(folder: Path) -> int:
    """Open the window as the command line does; runs in the process that is timed, which loads nothing else."""
    gc.disable()
    from fruitgui.gui.app import make_qt, run

    FirstPaint(make_qt())
    return run(folder)


if __name__ == "__main__":
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    sys.exit(_opened(Path(sys.argv[1])))
