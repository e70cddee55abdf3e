"""The window's process is killed in the middle of a lot: what it showed as counted is there, and work goes on."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

import psutil
import pytest

from fruitgui.records.lot_search import LotLine, LotQuery
from fruitgui.records.store import open_store
from fruitgui.station.workspace import open_workspace
from tests.gui.line_recording import LineRecording, line_recording

pytestmark = pytest.mark.xdist_group("window killed")

ENOUGH = 3
PATIENCE_S = 20.0


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> LineRecording:
    return line_recording(tmp_path_factory)


@contextmanager
def window(folder: Path, *how: str) -> Iterator[subprocess.Popen[str]]:
    """Run the window in a process of its own; kill it, and see that its helpers go too."""
    command = [sys.executable, "-m", "tests.window.counting", str(folder), *how]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=Path(__file__).parents[2]
    ) as process:
        helpers: list[psutil.Process] = []
        try:
            yield process
        finally:
            if process.poll() is None:
                helpers = psutil.Process(process.pid).children(recursive=True)
            process.kill()
    _, alive = psutil.wait_procs(helpers, timeout=PATIENCE_S)
    assert not alive, "helpers outlived the window"


def said(process: subprocess.Popen[str], word: str) -> str:
    """Return what the window says after a word."""
    assert process.stdout is not None
    assert process.stderr is not None
    for line in process.stdout:
        if line.startswith(word):
            return line.removeprefix(word).strip()
    raise AssertionError(process.stderr.read()[-3000:])


def kept(folder: Path) -> LotLine:
    with open_store(folder) as store:
        (line,) = store.lots.find(LotQuery()).lots
    return line


def test_nothing_that_was_shown_is_lost_and_the_lot_goes_on(recorded: LineRecording, tmp_path: Path) -> None:
    folder = tmp_path / "line"
    recorded.lay_out(open_workspace(folder))
    with window(folder) as process:
        shown = 0
        while shown < ENOUGH:
            shown = int(said(process, "shows"))
    after = kept(folder)
    assert after.lot.ended_s is None
    assert after.fruit >= shown
    with window(folder, "go-on") as process:
        assert "1184" in said(process, "offered")
        again = 0
        while again <= after.fruit:
            again = int(said(process, "shows"))
    assert kept(folder).fruit >= again
