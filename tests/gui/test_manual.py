from __future__ import annotations

import re
from pathlib import Path

import pytest
from PySide6.QtGui import QImageReader
from pytestqt.qtbot import QtBot

from fruitgui.calibration.result import REMEDIES
from fruitgui.gui.help_window import HelpWindow, manual_page
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.translate import LANGUAGES
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


def test_help_opens_at_the_step(qtbot: QtBot, theme: Theme, language: str, tmp_path: Path) -> None:
    window = HelpWindow(theme, language, tmp_path / "log.txt")
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


def test_nothing_is_wider_than_the_window(qtbot: QtBot, theme: Theme, language: str, tmp_path: Path) -> None:
    window = HelpWindow(theme, language, tmp_path / "log.txt")
    qtbot.addWidget(window)
    window.show()
    qtbot.waitUntil(lambda: window.text.verticalScrollBar().maximum() > 0)
    assert window.text.document().size().width() <= window.text.viewport().width()
    assert window.text.horizontalScrollBar().maximum() == 0


def test_the_manual_follows_the_theme(qtbot: QtBot, theme: Theme, tmp_path: Path) -> None:
    window = HelpWindow(theme, "en", tmp_path / "log.txt")
    qtbot.addWidget(window)
    before = window.text.document().begin().begin().fragment().charFormat().foreground().color()
    other = "light" if theme.name == "dark" else "dark"
    theme.name = other
    theme.changed.emit()
    after = window.text.document().begin().begin().fragment().charFormat().foreground().color()
    assert after == theme.colour("text")
    assert after != before


def test_a_language_without_a_manual_shows_the_english_one() -> None:
    assert manual_page("tlh").name == "en.md"
