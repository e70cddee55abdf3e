"""Memory is given back beside the window."""

from __future__ import annotations

from pytestqt.qtbot import QtBot

from fruitgui.gui.memory import GivingBack


def test_it_is_done_beside_the_window(qtbot: QtBot) -> None:
    giving = GivingBack()
    giving.give_back()
    assert giving.queries.busy
    qtbot.waitUntil(lambda: not giving.queries.busy, timeout=20_000)
