from __future__ import annotations

import re
from pathlib import Path

import pytest
from PySide6.QtCore import QEvent, QPoint
from PySide6.QtGui import QImageReader, QTextDocument
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from fruitgui.calibration.result import REMEDIES
from fruitgui.gui.help_window import HelpWindow, manual_page
from fruitgui.gui.manual_view import WIDEST_PX
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.translate import LANGUAGES, Language
from fruitgui.resources import folder
from fruitgui.station.workflow import Step

PICTURE_BYTES, PICTURE_WIDTH = 120_000, 1000
PICTURE = re.compile(r"!\[[^\]]+\]\(([^)]+)\)")


def pictures(page: Path) -> list[Path]:
    return [(page.parent / name).resolve() for name in PICTURE.findall(page.read_text(encoding="utf-8"))]


@pytest.fixture(params=sorted(LANGUAGES))
def language(request: pytest.FixtureRequest) -> str:
    return str(request.param)


def test_there_is_a_manual_in_every_language_with_a_chapter_for_every_step(language: str) -> None:
    page = manual_page(language)
    assert page.name == f"{language}.md"
    chapters = re.findall(r"^## (\d)\. ", page.read_text(encoding="utf-8"), re.MULTILINE)
    assert chapters == [str(number) for number in range(1, len(Step) + 1)]


def test_every_reason_for_which_calibrating_is_refused_is_told(language: str) -> None:
    told = manual_page(language).read_text(encoding="utf-8")
    assert [code for code in REMEDIES if f"`{code}`" not in told] == []


def test_the_pictures_are_there_and_small(language: str) -> None:
    shown = pictures(manual_page(language))
    assert shown
    for picture in shown:
        assert picture.parent == folder("docs") / "pictures" / "manual"
        assert picture.stat().st_size <= PICTURE_BYTES
        assert 0 < QImageReader(str(picture)).size().width() <= PICTURE_WIDTH


def test_no_picture_lies_there_that_no_manual_shows() -> None:
    shown = {picture.name for language in LANGUAGES for picture in pictures(manual_page(language))}
    assert {path.name for path in (folder("docs") / "pictures" / "manual").iterdir()} == shown


def _speaking(language: str) -> Language:
    """Return a language that is in force nowhere."""
    spoken = Language()
    spoken.name = language
    return spoken


def test_help_opens_at_the_step(qtbot: QtBot, theme: Theme, language: str, tmp_path: Path) -> None:
    window = HelpWindow(theme, _speaking(language), tmp_path / "log.txt")
    qtbot.addWidget(window)
    window.show()
    qtbot.waitUntil(lambda: window.text.verticalScrollBar().maximum() > 0)
    seen = []
    for number, step in enumerate(Step, start=1):
        window.show_step(step)
        seen.append(window.text.verticalScrollBar().value())
        at_top = window.text.cursorForPosition(window.text.viewport().rect().topLeft()).block()
        last = seen[-1] == window.text.verticalScrollBar().maximum()
        assert at_top.text().startswith(f"{number}.") or last
    assert seen == sorted(set(seen))


def test_what_is_read_stays_where_it_is_in_another_size_and_look(
    qtbot: QtBot, theme: Theme, language: str, tmp_path: Path
) -> None:
    window = HelpWindow(theme, _speaking(language), tmp_path / "log.txt")
    qtbot.addWidget(window)
    window.show()

    def at_top() -> str:
        return window.text.cursorForPosition(QPoint(0, 0)).block().text()

    begin = at_top()
    window.resize(1800, 900)
    assert at_top() == begin
    window.show_step(Step.TEACH)
    for width in (700, 1800, 960):
        window.resize(width, 680)
        assert at_top().startswith("4."), width
    theme.changed.emit()
    assert at_top().startswith("4.")


def test_lines_stay_short_and_in_the_middle_of_a_wide_window(qtbot: QtBot, theme: Theme, tmp_path: Path) -> None:
    window = HelpWindow(theme, _speaking("en"), tmp_path / "log.txt")
    qtbot.addWidget(window)
    window.resize(2400, 1200)
    window.show()
    place = window.text.viewport().geometry()
    assert place.width() <= WIDEST_PX
    assert abs(place.center().x() - window.text.rect().center().x()) <= 20


def test_nothing_is_wider_than_the_window(qtbot: QtBot, theme: Theme, language: str, tmp_path: Path) -> None:
    window = HelpWindow(theme, _speaking(language), tmp_path / "log.txt")
    qtbot.addWidget(window)
    window.show()
    qtbot.waitUntil(lambda: window.text.verticalScrollBar().maximum() > 0)
    assert window.text.document().size().width() <= window.text.viewport().width()
    assert window.text.horizontalScrollBar().maximum() == 0


def test_the_manual_follows_the_theme(qtbot: QtBot, theme: Theme, tmp_path: Path) -> None:
    window = HelpWindow(theme, _speaking("en"), tmp_path / "log.txt")
    qtbot.addWidget(window)
    before = window.text.document().begin().begin().fragment().charFormat().foreground().color()
    other = "light" if theme.name == "dark" else "dark"
    theme.name = other
    theme.changed.emit()
    after = window.text.document().begin().begin().fragment().charFormat().foreground().color()
    assert after == theme.colour("text")
    assert after != before


def test_help_that_is_open_takes_over_another_language(
    qtbot: QtBot, qapp: QApplication, theme: Theme, tmp_path: Path
) -> None:
    language = Language()
    window = HelpWindow(theme, language, tmp_path / "log.txt")
    qtbot.addWidget(window)
    window.show()
    window.show_step(Step.BELT)
    english = window.windowTitle(), window.text.toPlainText()
    language.put_on(qapp, "es")
    qapp.processEvents()
    try:
        at_top = window.text.cursorForPosition(window.text.viewport().rect().topLeft()).block().text()
        spanish = window.windowTitle(), window.text.toPlainText()
    finally:
        language.put_on(qapp, "en")
        qapp.processEvents()
    assert at_top.startswith("3."), "it stays at its chapter"
    assert all(one != other for one, other in zip(english, spanish, strict=True))
    assert (window.windowTitle(), window.text.toPlainText()) == english
    for name in ("es", "en", "es", "en"):
        language.put_on(qapp, name)
        qapp.processEvents()
    qapp.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    assert len(window.text.findChildren(QTextDocument)) == 1, "pages that were shown before are not kept"


def test_a_language_without_a_manual_shows_the_english_one() -> None:
    assert manual_page("tlh").name == "en.md"
