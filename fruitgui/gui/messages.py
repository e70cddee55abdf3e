"""The one door through which the window speaks to the operator."""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from functools import partial

from PySide6.QtCore import QObject, Signal

from fruitgui.errors import FruitguiError
from fruitgui.gui import error_words
from fruitgui.gui.told import Telling

log = logging.getLogger(__name__)


class Level(Enum):
    """How much a message matters; each has an icon of the same name."""

    INFO = "info"
    GOOD = "good"
    WARN = "warn"
    BAD = "bad"


@dataclass(frozen=True, slots=True, eq=False)
class Message:
    """One thing said; its words are found anew whenever they are asked for, in the language in force then.

    Attributes:
        level: how much it matters.
        told: what happened, what to do, and the word on a button, for example Undo.
        act: what that button does.
        stays: until the person has closed it; others go by themselves.
    """

    level: Level
    told: Telling
    act: Callable[[], None] | None = None
    stays: bool = False

    @property
    def what(self) -> str:
        """What happened, and what it means."""
        return self.told().what

    @property
    def remedy(self) -> str:
        """What to do; empty where there is nothing to do."""
        return self.told().remedy

    @property
    def action(self) -> str:
        """The word on its button; empty where it has none."""
        return self.told().action

    def says_as(self, other: Message | None) -> bool:
        """Whether a person reads the same in another one."""
        return other is not None and (self.level, self.told()) == (other.level, other.told())


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
        now = self.standing
        if now is not before and not (now is not None and now.says_as(before)):
            self.standing_changed.emit(now)

    def info(self, told: Telling, act: Callable[[], None] | None = None) -> None:
        """Say what was done, with a way to undo it where there is one."""
        self.say(Message(Level.INFO, told, act))

    def good(self, told: Telling) -> None:
        """Say that something worked."""
        self.say(Message(Level.GOOD, told))

    def warn(self, told: Telling, *, stays: bool = False) -> None:
        """Say what should be looked after."""
        self.say(Message(Level.WARN, told, stays=stays))

    def error(self, error: FruitguiError) -> None:
        """Say what failed and what to do; the log has it as exactly as the core said it."""
        log.error("%s: %s %s", error.code, error.what, error.remedy)
        self.say(error_message(error))


def error_message(error: FruitguiError) -> Message:
    """Return an error as a message."""
    return Message(Level.BAD, partial(error_words.told, error), stays=True)


_WEIGHTS = {
    Level.INFO: logging.INFO, Level.GOOD: logging.INFO, Level.WARN: logging.WARNING, Level.BAD: logging.ERROR,
}  # fmt: skip
