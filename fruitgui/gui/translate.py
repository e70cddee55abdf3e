"""The window's language: Qt's translation files, one for each part of the window."""

from __future__ import annotations

from PySide6.QtCore import QLibraryInfo, QLocale, QObject, QTranslator
from PySide6.QtWidgets import QApplication

from fruitgui.resources import folder

LANGUAGES = {"en": "English", "es": "Español"}
"""The languages that the window speaks, each under its own name."""


class Language(QObject):
    """The language in force; English is what stands in the code."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._translators: list[QTranslator] = []
        self.name = "en"

    def put_on(self, application: QApplication, name: str) -> None:
        """Let the application speak a language; an empty name is the system's, one that is not known is English."""
        for translator in self._translators:
            application.removeTranslator(translator)
        self._translators = []
        self.name = name or system_language()
        QLocale.setDefault(QLocale(self.name))
        if self.name == "en":
            return
        for path in sorted((folder("translations") / self.name).glob("*.qm")):
            self._install(application, str(path))
        self._install(application, f"{_qt_translations()}/qtbase_{self.name}.qm")

    def _install(self, application: QApplication, path: str) -> None:
        translator = QTranslator(self)
        if translator.load(path):
            application.installTranslator(translator)
            self._translators.append(translator)


def system_language() -> str:
    """Return the system's language where the window speaks it, else English."""
    language = QLocale.system().name().split("_")[0]
    return language if language in LANGUAGES else "en"


def _qt_translations() -> str:
    return QLibraryInfo.path(QLibraryInfo.LibraryPath.TranslationsPath)
