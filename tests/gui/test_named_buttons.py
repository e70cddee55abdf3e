"""Whatever is pressed says what it is, in the window's language.

In words; or where there is only a drawing, to a pointer that rests on it and to a screen reader.
"""

from __future__ import annotations

import pytest
from PySide6.QtWidgets import QAbstractButton, QApplication, QWidget
from pytestqt.qtbot import QtBot

from fruitgui.gui.action_bar import ActionBar
from fruitgui.gui.session import Session
from fruitgui.gui.steps.live.page import LivePage
from fruitgui.gui.steps.lots.page import LotsPage
from fruitgui.gui.steps.page import StepPage
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.top_bar import TopBar
from fruitgui.gui.translate import Language

PARTS = {
    "live": LivePage,
    "lots": LotsPage,
    "top": lambda _session, theme: TopBar(theme),
    "bottom": lambda _session, theme: ActionBar(theme),
}


def _said(widget: QWidget) -> dict[str, tuple[str, str, str]]:
    """Return what each button of a part says, by its place in it: its words, its name, its tip."""
    buttons = [
        one
        for one in widget.findChildren(QAbstractButton)
        if not (one.objectName().startswith("qt_") or one.isHidden())
    ]
    return {str(at): (one.text(), one.accessibleName(), one.toolTip()) for at, one in enumerate(buttons)}


@pytest.mark.parametrize("part", PARTS)
def test_buttons_without_words_have_a_name_and_a_tip(
    qtbot: QtBot, session: Session, theme: Theme, qapp: QApplication, part: str
) -> None:
    made = PARTS[part](session, theme)
    if isinstance(made, StepPage):
        made.complete()
    qtbot.addWidget(made)
    english = _said(made)
    for words, name, tip in english.values():
        assert words or (name and tip), (words, name, tip)
    language = Language()
    language.put_on(qapp, "es")
    qapp.processEvents()
    try:
        for at, (words, name, tip) in _said(made).items():
            if not words and name:
                assert name != english[at][1], f"{name} is still English"
                assert tip != english[at][2], f"{tip} is still English"
    finally:
        language.put_on(qapp, "en")
