from __future__ import annotations

from collections.abc import Callable

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QDialogButtonBox
from pytestqt.qtbot import QtBot

from fruitgui.gui.settings_dialog import SettingsDialog
from fruitgui.gui.steps.connect.record_dialog import RecordDialog
from fruitgui.gui.steps.live.lot_dialog import LotDialog
from fruitgui.gui.translate import Language
from fruitgui.station.settings import Settings


@pytest.mark.usefixtures("theme")
def test_settings_are_taken_as_they_stand_in_the_dialog(qtbot: QtBot) -> None:
    dialog = SettingsDialog(Settings(crops_kept_days=30))
    qtbot.addWidget(dialog)
    assert dialog.chosen == Settings(crops_kept_days=30)
    dialog.language.setCurrentIndex(dialog.language.findData("es"))
    dialog.theme.setCurrentIndex(dialog.theme.findData("light"))
    dialog.pictures.choice.setCurrentIndex(dialog.pictures.choice.findText("For ever"))
    box = dialog.findChild(QDialogButtonBox)
    assert isinstance(box, QDialogButtonBox)
    with qtbot.waitSignal(dialog.accepted):
        qtbot.mouseClick(box.button(QDialogButtonBox.StandardButton.Save), Qt.MouseButton.LeftButton)
    assert dialog.chosen == Settings(language="es", theme="light", crops_kept_days=0)


@pytest.mark.usefixtures("theme")
@pytest.mark.parametrize("proposed", ["", "1185"])
@pytest.mark.parametrize("made", [LotDialog, lambda name: RecordDialog(name, 10**9, "recordings")])
def test_a_name_is_typed_and_return_begins(
    qtbot: QtBot, qapp: QApplication, made: Callable[[str], LotDialog | RecordDialog], proposed: str
) -> None:
    dialog = made(proposed)
    qtbot.addWidget(dialog)
    dialog.open()
    dialog.activateWindow()
    qtbot.waitUntil(lambda: qapp.focusWidget() is dialog.name)
    qtbot.keyClicks(qapp.focusWidget(), "1186")
    assert dialog.name.text() == "1186", "what was proposed gives way"
    with qtbot.waitSignal(dialog.accepted):
        qtbot.keyClick(qapp.focusWidget(), Qt.Key.Key_Return)


@pytest.mark.usefixtures("theme")
@pytest.mark.parametrize(("days", "said"), [
    (7, "A week"), (30, "A month"), (90, "A season: three months"), (365, "A year"), (0, "For ever"),
])  # fmt: skip
def test_how_long_pictures_are_kept_is_said_in_words(qtbot: QtBot, days: int, said: str) -> None:
    dialog = SettingsDialog(Settings(crops_kept_days=days))
    qtbot.addWidget(dialog)
    dialog.show()
    assert dialog.pictures.choice.currentText() == said
    assert not dialog.pictures.own.isVisible()
    assert dialog.chosen.crops_kept_days == days


@pytest.mark.usefixtures("theme")
def test_a_number_of_days_that_has_no_word_stays_as_it_was_typed(qtbot: QtBot) -> None:
    dialog = SettingsDialog(Settings(crops_kept_days=45))
    qtbot.addWidget(dialog)
    dialog.show()
    pictures = dialog.pictures
    assert (pictures.choice.currentText(), pictures.own.value()) == ("Another number of days", 45.0)
    assert pictures.own.isVisible()
    assert dialog.chosen.crops_kept_days == 45
    pictures.choice.setCurrentIndex(pictures.choice.findText("For ever"))
    assert not pictures.own.isVisible()
    assert dialog.chosen.crops_kept_days == 0
    pictures.choice.setCurrentIndex(pictures.choice.count() - 1)
    pictures.own.setValue(0)
    assert dialog.chosen.crops_kept_days == 1, "no number of days means for ever, but the word"


@pytest.mark.usefixtures("theme")
@pytest.mark.parametrize(
    ("before", "chosen", "gone"), [(90, 30, True), (0, 365, True), (90, 0, False), (30, 90, False)]
)
def test_it_is_said_beforehand_that_pictures_go_for_good(qtbot: QtBot, before: int, chosen: int, gone: bool) -> None:
    dialog = SettingsDialog(Settings(crops_kept_days=before))
    qtbot.addWidget(dialog)
    assert "for good" not in dialog.gone.text()
    dialog.pictures.choice.setCurrentIndex(dialog.pictures.choice.findData(chosen))
    assert ("for good" in dialog.gone.text()) == gone
    assert dialog.gone.property("health") == ("warn" if gone else "")


@pytest.mark.usefixtures("theme")
def test_a_size_of_words_that_was_chosen_stays(qtbot: QtBot) -> None:
    dialog = SettingsDialog(Settings(words_percent=150))
    qtbot.addWidget(dialog)
    assert dialog.chosen.words_percent == 150
    dialog.words.setCurrentIndex(dialog.words.findData(100))
    assert dialog.chosen == Settings()


@pytest.mark.usefixtures("theme")
def test_fields_of_a_later_version_survive_the_dialog(qtbot: QtBot) -> None:
    dialog = SettingsDialog(Settings.model_validate({"theme": "dark", "from_the_future": 7}))
    qtbot.addWidget(dialog)
    assert dialog.chosen.model_dump()["from_the_future"] == 7


def test_the_window_speaks_spanish_and_english_again(qapp: QApplication) -> None:
    language = Language()
    language.put_on(qapp, "es")
    assert qapp.translate("Steps", "Belt") == "Cinta"
    language.put_on(qapp, "en")
    assert qapp.translate("Steps", "Belt") == "Belt"
