from __future__ import annotations

from collections.abc import Iterator

import pytest
from PySide6.QtCore import QCoreApplication, QEvent, QLocale, Qt
from PySide6.QtGui import QGuiApplication
from pytestqt.qtbot import QtBot

from fruitgui.gui.settings_dialog import SettingsDialog
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.widgets.decimal_box import DecimalBox, read_decimal
from fruitgui.gui.widgets.stepper import Stepper
from fruitgui.station.settings import Settings

LANGUAGES = ("en", "es")


@pytest.fixture(autouse=True)
def english_again() -> Iterator[None]:
    yield
    QLocale.setDefault(QLocale("en"))


def speed_box(qtbot: QtBot, language: str, low: float = 0.0, high: float = 5.0, digits: int = 3) -> DecimalBox:
    QLocale.setDefault(QLocale(language))
    box = DecimalBox()
    qtbot.addWidget(box)
    box.setDecimals(digits)
    box.setRange(low, high)
    box.setSuffix("\u2009m/s")
    box.setValue(max(low, 0.25))
    return box


def typed(qtbot: QtBot, box: DecimalBox, text: str) -> float:
    box.selectAll()
    qtbot.keyClicks(box, text)
    qtbot.keyClick(box, Qt.Key.Key_Return)
    return box.value()


def pasted(qtbot: QtBot, box: DecimalBox, text: str) -> float:
    QGuiApplication.clipboard().setText(text)
    box.selectAll()
    qtbot.keyClick(box, Qt.Key.Key_V, Qt.KeyboardModifier.ControlModifier)
    qtbot.keyClick(box, Qt.Key.Key_Return)
    return box.value()


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize(
    ("text", "value"),
    [("0.5", 0.5), ("0,5", 0.5), (".5", 0.5), (",5", 0.5), ("2", 2.0), ("1.234", 1.234), ("1,234", 1.234), ("3,", 3.0)],
)
def test_a_point_and_a_comma_are_the_same(qtbot: QtBot, language: str, text: str, value: float) -> None:
    assert typed(qtbot, speed_box(qtbot, language), text) == value
    assert pasted(qtbot, speed_box(qtbot, language), text) == value


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("text", ["1.234,5", "1,234.5", "1 234", "1'234", "1e3", "0.1234", "half", "-1", "7"])
def test_what_is_no_number_within_the_limits_cannot_be_pasted(qtbot: QtBot, language: str, text: str) -> None:
    assert pasted(qtbot, speed_box(qtbot, language), text) == 0.25


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_number_is_pasted_with_blanks(qtbot: QtBot, language: str) -> None:
    assert pasted(qtbot, speed_box(qtbot, language), " 0,75 ") == 0.75


@pytest.mark.parametrize(("language", "text"), [("en", "0.500\u2009m/s"), ("es", "0,500\u2009m/s")])
def test_a_number_is_shown_in_the_window_s_language(qtbot: QtBot, language: str, text: str) -> None:
    box = speed_box(qtbot, language)
    typed(qtbot, box, "0,5" if language == "en" else "0.5")
    assert box.text() == text


def test_a_number_is_shown_anew_in_another_language_and_stays_what_it_was(qtbot: QtBot) -> None:
    box = speed_box(qtbot, "en")
    QLocale.setDefault(QLocale("es"))
    QCoreApplication.sendEvent(box, QEvent(QEvent.Type.LanguageChange))
    assert (box.text(), box.value()) == ("0,250\u2009m/s", 0.25)


@pytest.mark.parametrize("language", LANGUAGES)
def test_whole_numbers_refuse_a_sign_and_never_lose_one(qtbot: QtBot, language: str) -> None:
    box = speed_box(qtbot, language, high=2000.0, digits=0)
    assert {pasted(qtbot, box, text) for text in ("1.234", "1,234")} == {0.0}
    assert typed(qtbot, box, "1234") == 1234.0
    assert box.text() == "1234\u2009m/s"


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_number_below_the_least_can_be_typed_on(qtbot: QtBot, language: str) -> None:
    box = speed_box(qtbot, language, low=20.0, high=300.0, digits=1)
    assert typed(qtbot, box, "150,5") == 150.5
    assert typed(qtbot, box, "5") == 150.5, "what stays below the least is not taken"
    assert typed(qtbot, speed_box(qtbot, language, low=-180.0, high=180.0), "-12,5") == -12.5


@pytest.mark.parametrize(("language", "key"), [("en", ","), ("es", ".")])
def test_steppers_read_numbers_so(qtbot: QtBot, theme: Theme, language: str, key: str) -> None:
    QLocale.setDefault(QLocale(language))
    stepper = Stepper(theme, 3, "m/s")
    qtbot.addWidget(stepper)
    stepper.set_range(0.0, 5.0, 0.01)
    told: list[float] = []
    stepper.changed.connect(told.append)
    assert typed(qtbot, stepper.box, f"0{key}5") == 0.5
    assert set(told) == {0.5}, "no other number is told of on the way"


@pytest.mark.usefixtures("theme")
@pytest.mark.parametrize("language", LANGUAGES)
def test_the_room_on_the_disk_is_kept_to_the_megabyte(qtbot: QtBot, language: str) -> None:
    QLocale.setDefault(QLocale(language))
    dialog = SettingsDialog(Settings(least_free_mb=1503))
    qtbot.addWidget(dialog)
    assert dialog.chosen.least_free_mb == 1503, "a limit that nobody touched stays as it is"
    typed(qtbot, dialog.free_gb, "0.5")
    assert dialog.chosen.least_free_mb == 500
    typed(qtbot, dialog.free_gb, "2,25")
    assert dialog.chosen.least_free_mb == 2250
    own = dialog.pictures.own
    dialog.pictures.choice.setCurrentIndex(dialog.pictures.choice.count() - 1)
    typed(qtbot, own, "1.5")
    assert (dialog.chosen.crops_kept_days, own.value()) == (1, 1.0), "a day and a half is no fifteen"


def test_only_a_number_is_read() -> None:
    assert read_decimal(" 12,5 ") == 12.5
    assert all(read_decimal(text) is None for text in ("", ".", "-", "1.2.3", "1,2,3", "1.000,0", "nan", "inf"))
