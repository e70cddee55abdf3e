"""Where pictures are taken: a window on a folder made for the purpose, in any size, theme and language."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from PySide6.QtCore import QCoreApplication, QDeadlineTimer, QEventLoop
from PySide6.QtWidgets import QApplication, QWidget

from fruitgui.gui.queries import Queries
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.translate import Language

SIZES = {"1280x720": (1280, 720), "1920x1080": (1920, 1080), "3840x2160": (3840, 2160)}
MOST_MS = 60_000


@dataclass(frozen=True, slots=True)
class Scene:
    """One screen in one state.

    Attributes:
        name: of the pictures' files, `step-state`.
        opened: gives the widget to take, ready, and cleans up after it.
    """

    name: str
    opened: Callable[[Stage], AbstractContextManager[QWidget]]


class Stage:
    """What scenes are given: the application, its look, and a folder."""

    def __init__(self, qt: QApplication, folder: Path) -> None:
        self.qt = qt
        self.folder = folder
        self.theme = Theme()
        self.language = Language()

    def dress(self, theme: str, language: str) -> None:
        """Put on a theme and a language."""
        self.language.put_on(self.qt, language)
        self.theme.put_on(self.qt, theme)
        self.settle()

    def settle(self) -> None:
        """Let Qt do what is waiting to be done, deletions too."""
        for _ in range(5):
            QCoreApplication.processEvents()
            QCoreApplication.sendPostedEvents(None, 52)  # QEvent.Type.DeferredDelete

    def wait_until(self, ready: Callable[[], bool], most_ms: int = MOST_MS) -> None:
        """Run the window until a condition holds.

        Raises:
            TimeoutError: it did not come to hold.
        """
        deadline = QDeadlineTimer(most_ms)
        while not ready():
            if deadline.hasExpired():
                raise TimeoutError("the screen did not become what was to be shown")
            QCoreApplication.processEvents(QEventLoop.ProcessEventsFlag.WaitForMoreEvents, 50)


def drawn(widget: QWidget) -> bool:
    """Tell whether all that is made beside the window for what a widget shows is there."""
    widget.grab()  # what is painted asks for what it misses
    return not any(one.busy for one in widget.findChildren(Queries))


def taken(stage: Stage, scene: Scene, sizes: tuple[str, ...], themes: tuple[str, ...], languages: tuple[str, ...],
          out: Path) -> Iterator[Path]:  # fmt: skip
    """Take a scene in every size, theme and language; yield the files."""
    stage.dress(themes[0], languages[0])
    with scene.opened(stage) as widget:
        for language in languages:
            for theme in themes:
                stage.dress(theme, language)
                for size in sizes:
                    widget.resize(*SIZES[size])
                    stage.settle()
                    stage.wait_until(partial(drawn, widget))
                    path = out / f"{scene.name}-{size}-{theme}-{language}.png"
                    widget.grab().save(str(path))
                    yield path
