from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QDialogButtonBox
from pytestqt.qtbot import QtBot

from fruitgui.gui.settings_dialog import SettingsDialog
from fruitgui.gui.translate import Language
from fruitgui.station.settings import Settings


@pytest.mark.usefixtures("theme")
def test_settings_are_taken_as_they_stand_in_the_dialog(qtbot: QtBot) -> None:
    dialog = SettingsDialog(Settings(crops_kept_days=30))
    qtbot.addWidget(dialog)
    assert dialog.chosen == Settings(crops_kept_days=30)
    dialog.language.setCurrentIndex(dialog.language.findData("es"))
    dialog.theme.setCurrentIndex(dialog.theme.findData("light"))
    dialog.days.setValue(0)
    box = dialog.findChild(QDialogButtonBox)
    assert isinstance(box, QDialogButtonBox)
    with qtbot.waitSignal(dialog.accepted):
        qtbot.mouseClick(box.button(QDialogButtonBox.StandardButton.Save), Qt.MouseButton.LeftButton)
    assert dialog.chosen == Settings(language="es", theme="light", crops_kept_days=0)


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
