"""The one door through which the window speaks to the operator."""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import dataclass, field
from enum import Enum
from functools import partial

from PySide6.QtCore import QObject, Signal

from fruitgui.errors import FruitguiError
from fruitgui.gui import error_words

log = logging.getLogger(__name__)


class Level(Enum):
    """How much a message matters; each has an icon of the same name."""

    INFO = "info"
    GOOD = "good"
    WARN = "warn"
    BAD = "bad"


@dataclass(frozen=True, slots=True)
class Message:
    """One thing said.

    Attributes:
        level: how much it matters.
        what: what happened, and what it means.
        remedy: what to do; empty where there is nothing to do.
        action, act: a word on a button, and what it does; for example Undo.
        stays: until the person has closed it; others go by themselves.
        again: says the same in the language that the window speaks now; None where the words are all there is.
    """

    level: Level
    what: str
    remedy: str = ""
    action: str = ""
    act: Callable[[], None] | None = None
    stays: bool = False
    again: Callable[[], Message] | None = field(default=None, compare=False)


class Messages(QObject):
    """Takes messages from anywhere on the window's thread, and hands them to the action bar.

    Attributes:
        said: a new `Message`.
        standing_changed: what holds now is another `Message`, see `stand`, or None.
    """

    said = Signal(object)
    standing_changed = Signal(object)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.history: list[Message] = []
        self._standing: dict[str, Message] = {}

    def say(self, message: Message) -> None:
        """Say it, and keep it in the history."""
        self.history = [*self.history[-199:], message]
        log.log(_WEIGHTS[message.level], "%s %s", message.what, message.remedy)
        self.said.emit(message)

    @property
    def standing(self) -> Message | None:
        """What holds now and matters most; None where nothing does."""
        order = list(Level)
        return max(self._standing.values(), key=lambda one: order.index(one.level), default=None)

    def stand(self, name: str, message: Message | None) -> None:
        """Show what holds, under a name, until it is told to hold no more (None); it goes by nothing else."""
        before = self.standing
        if message is None:
            self._standing.pop(name, None)
        else:
            self._standing[name] = message
        if self.standing != before:
            self.standing_changed.emit(self.standing)

    def info(self, what: str, action: str = "", act: Callable[[], None] | None = None) -> None:
        """Say what was done, with a way to undo it where there is one."""
        self.say(Message(Level.INFO, what, action=action, act=act))

    def good(self, what: str) -> None:
        """Say that something worked."""
        self.say(Message(Level.GOOD, what))

    def warn(self, what: str, remedy: str = "", *, stays: bool = False) -> None:
        """Say what should be looked after."""
        self.say(Message(Level.WARN, what, remedy, stays=stays))

    def error(self, error: FruitguiError) -> None:
        """Say what failed and what to do; the log has it as exactly as the core said it."""
        log.error("%s: %s %s", error.code, error.what, error.remedy)
        self.say(error_message(error))


def error_message(error: FruitguiError) -> Message:
    """Return an error as a message, in the language that the window speaks now."""
    told = error_words.told(error)
    return Message(Level.BAD, told.what, told.remedy, stays=True, again=partial(error_message, error))


_WEIGHTS = {
    Level.INFO: logging.INFO, Level.GOOD: logging.INFO, Level.WARN: logging.WARNING, Level.BAD: logging.ERROR,
}  # fmt: skip
