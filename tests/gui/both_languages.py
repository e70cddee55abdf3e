"""Whether what the window says is worded when it is shown: all that is said in a test is asked for in Spanish, too."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial

from PySide6.QtCore import QEvent, QObject, QTranslator
from PySide6.QtWidgets import QApplication

from fruitgui.gui.messages import Level, Message
from fruitgui.gui.tasks import Task
from fruitgui.resources import folder


class _Hush(QObject):
    """Keeps from all widgets that the language is another one for a moment."""

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        return event.type() == QEvent.Type.LanguageChange


class BothLanguages:
    """Notes what stays as it is when the window speaks Spanish.

    Attributes:
        fixed: words of the product that were worded before they were shown.
    """

    def __init__(self, application: QApplication) -> None:
        self._application = application
        self._hush = _Hush()
        self._translators: list[QTranslator] = []
        for path in sorted((folder("translations") / "es").glob("*.qm")):
            translator = QTranslator()
            assert translator.load(str(path))
            self._translators.append(translator)
        self.fixed: list[str] = []

    def hear(self, message: Message) -> None:
        """Take note of a message; an error may be one that only a test knows, in words of its own."""
        if message.level is not Level.BAD:
            self.hear_words(message.told)

    def hear_words(self, words: Callable[[], object]) -> None:
        """Take note of some words, if the product says them."""
        if not _of_product(words):
            return
        before = words()
        with self._spanish():
            if words() == before:
                self.fixed.append(str(before))

    def hear_doing(self, task: Task[object], said: str) -> None:
        """Take note of what a task says of its progress, if that is a sentence and no name of a file or a sensor."""
        if not re.search(r"[A-Za-z]{2,} [a-z]{2,}", said):
            return
        with self._spanish():
            if task.doing == said:
                self.fixed.append(said)

    @contextmanager
    def _spanish(self) -> Iterator[None]:
        self._application.installEventFilter(self._hush)
        for translator in self._translators:
            self._application.installTranslator(translator)
        try:
            yield
        finally:
            for translator in self._translators:
                self._application.removeTranslator(translator)
            self._application.removeEventFilter(self._hush)


def _of_product(words: Callable[[], object]) -> bool:
    function = words.func if isinstance(words, partial) else words
    return str(getattr(function, "__module__", "")).startswith("fruitgui.")
