"""The small files of a line as the window holds them: written beside it, in order, and told of once they are."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Generic, TypeVar

from PySide6.QtCore import QObject, Signal

from fruitgui.errors import FruitguiError
from fruitgui.gui.messages import Messages
from fruitgui.gui.queries import Queries
from fruitgui.station.kept_file import KeptFile

T = TypeVar("T")
D = TypeVar("D")


class Saving(QObject):
    """Writes one file after the other, on a thread of its own; the disk may be slow, the window never is."""

    def __init__(self, messages: Messages, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._messages = messages
        self._queries = Queries(self)
        self._queries.failed.connect(self.fail)
        self._failures = 0

    @property
    def busy(self) -> bool:
        """Whether something is not on the disk yet, or not told."""
        return self._queries.busy

    def write(self, write: Callable[[], T], written: Callable[[T | FruitguiError], None]) -> None:
        """Write after all that was to be written before; what comes of it is told on the window's thread."""
        self._queries.change(partial(_attempted, write), written)

    def fail(self, error: FruitguiError) -> None:
        """Say that something could not be written."""
        self._failures += 1
        self._messages.error(error)

    def after(self, told: Callable[[], None]) -> None:
        """Call `told` once all that was to be written is on the disk; never where some of it could not be written."""
        failures = self._failures
        self._queries.change(lambda: None, lambda _: told() if self._failures == failures else None)

    def wait(self) -> None:
        """Wait until all is on the disk; for jobs on threads of their own that read it there, never for the window."""
        self._queries.wait_for_changes()

    def finish(self) -> bool:
        """Wait until all is on the disk; tell whether it is, in reasonable time."""
        return self._queries.finish()


class KeptValue(QObject, Generic[T, D]):
    """What a file holds, as the window has it: a change is taken at once, and told once it is on the disk.

    Args:
        file: that holds it.
        value: that it holds now, or what stands for it where there is no file.
        saving: writes it.

    Attributes:
        path: of the file.
        changed: a change is on the disk, or could not be written, in which case the value is as it was.
    """

    changed = Signal()

    def __init__(self, file: KeptFile[T], value: T | D, saving: Saving, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._file = file
        self.path = file.path
        self._value: T | D = value
        self._written: T | D = value
        self._saving = saving
        self._newest = 0

    @property
    def value(self) -> T | D:
        """The newest value, which may still be on its way to the disk: what is changed further begins with it."""
        return self._value

    def put(self, value: T) -> None:
        """Change it; the value before can be taken back."""
        self._value = value

        def write() -> T:
            self._file.save(value)
            return value

        self._write(write)

    def take_back(self) -> None:
        """Return to the value before the last change, also where the file was damaged; again undoes this."""
        self._write(self._file.restore)

    def _write(self, write: Callable[[], T]) -> None:
        self._newest += 1
        self._saving.write(write, partial(self._done, self._newest))

    def _done(self, number: int, outcome: T | FruitguiError) -> None:
        if isinstance(outcome, FruitguiError):
            self._saving.fail(outcome)
        else:
            self._written = outcome
        if number == self._newest:
            self._value = self._written
        self.changed.emit()


def _attempted(write: Callable[[], T]) -> T | FruitguiError:
    """Return what writing gives, or why it could not be written; any thread may call."""
    try:
        return write()
    except FruitguiError as error:
        return error
