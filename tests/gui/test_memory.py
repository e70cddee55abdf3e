"""Memory is given back beside the window."""

from __future__ import annotations

import subprocess
import sys

from pytestqt.qtbot import QtBot

from fruitgui.gui.memory import GivingBack


def test_it_is_done_beside_the_window(qtbot: QtBot) -> None:
    giving = GivingBack()
    giving.give_back()
    assert giving.queries.busy
    qtbot.waitUntil(lambda: not giving.queries.busy, timeout=20_000)


def test_sources_of_what_the_window_stands_on_are_not_kept() -> None:
    kept = "sum(one[0] for one in linecache.cache.values() if len(one) > 1)"
    program = f"import fruitgui.gui.app, linecache; print({kept})"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True, timeout=120)
    assert int(done.stdout) < 5_000_000
