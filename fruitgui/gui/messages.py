"""The one door through which the window speaks to the operator."""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import Enum
from functools import partial

from PySide6.QtCore import QObject, Signal

from fruitgui.errors import FruitguiError
from fruitgui.gui import error_words
from fruitgui.gui.step_words import way_words
from fruitgui.gui.told import Telling, Told
from fruitgui.gui.ways import mends_error
from fruitgui.station.workflow import Step

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
        step_wanted: the operator goes to the `Step` that mends what was said.
    """

    said = Signal(object)
    standing_changed = Signal(object)
    step_wanted = Signal(object)

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

    def warn(self, told: Telling) -> None:
        """Say what should be looked after."""
        self.say(Message(Level.WARN, told))

    def error(self, error: FruitguiError) -> None:
        """Say what failed and what to do, with the way there; the log has it as exactly as the core said it."""
        log.error("%s: %s %s", error.code, error.what, error.remedy)
        step = mends_error(error.code)
        lead = None if step is None else partial(self.step_wanted.emit, step)
        self.say(Message(Level.BAD, partial(_told, error, step), lead, stays=True))


def _told(error: FruitguiError, step: Step | None) -> Told:
    told = error_words.told(error)
    return told if step is None else replace(told, action=way_words(step)[0])


_WEIGHTS = {
    Level.INFO: logging.INFO, Level.GOOD: logging.INFO, Level.WARN: logging.WARNING, Level.BAD: logging.ERROR,
}  # fmt: skip
