"""A small file whose last good state is kept beside it; what is damaged is named and set aside, never written over."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Generic, TypeVar

from fruitgui.errors import FruitguiError, InputError
from fruitgui.files import written_whole

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Damage:
    """A file that could not be read.

    Attributes:
        file: its name.
        error: what is wrong with it.
        set_aside: where it lies now, unharmed; None where it was left in its place.
        last_good: a file that holds the last good state and can be read; None where there is none.
    """

    file: Path
    error: FruitguiError
    set_aside: Path | None
    last_good: Path | None


@dataclass(frozen=True, slots=True)
class Kept(Generic[T]):
    """What a file held.

    Attributes:
        value: None where there is no file, or none that can be read.
        damage: set where there was a file and it could not be read.
    """

    value: T | None
    damage: Damage | None = None


class KeptFile(Generic[T]):
    """One file, and `NAME.previous.SUFFIX` beside it with the state before the last write.

    Args:
        path: of the file.
        read: returns what a file holds, or raises `InputError`.
        write: writes a value whole or not at all, or raises `WorldError`.
    """

    def __init__(self, path: Path, read: Callable[[Path], T], write: Callable[[Path, T], None]) -> None:
        self.path = path
        self.previous_path = path.with_name(f"{path.stem}.previous{path.suffix}")
        self._read = read
        self._write = write

    def load(self) -> Kept[T]:
        """Return what the file holds; a damaged one is moved aside first."""
        if not self.path.exists():
            return Kept(None)
        try:
            return Kept(self._read(self.path))
        except InputError as error:
            aside = None if error.code == "cannot_read" else set_aside(self.path)
            return Kept(None, Damage(self.path, error, aside, self.previous_path if self._has_previous() else None))

    def glance(self) -> T | None:
        """Return what the file holds and touch nothing; None where it cannot be read."""
        return self._readable(self.path)

    def save(self, value: T) -> None:
        """Write a value; what was good before is kept as the previous state.

        Raises:
            WorldError: it cannot be written.
        """
        self._keep()
        self._write(self.path, value)

    def restore(self) -> T:
        """Take the previous state back; the present one becomes the previous, so that this can be undone as well.

        Raises:
            InputError: there is no previous state, or it cannot be read.
            WorldError: it cannot be written.
        """
        value = self._read(self.previous_path)
        self.save(value)
        return value

    def previous(self) -> T | None:
        """Return the previous state; None where there is none that can be read."""
        return self._readable(self.previous_path)

    def _readable(self, path: Path) -> T | None:
        try:
            return self._read(path) if path.exists() else None
        except InputError:
            return None

    def _has_previous(self) -> bool:
        return self.previous() is not None

    def _keep(self) -> None:
        """Copy the present state to the previous, unless it is damaged."""
        if not self.path.exists():
            return
        try:
            self._read(self.path)
        except InputError:
            set_aside(self.path)
            return
        with written_whole(self.previous_path) as beside:
            shutil.copyfile(self.path, beside)


def set_aside(path: Path) -> Path | None:
    """Rename a file to `NAME.damaged-N.SUFFIX`, N the first that is free; None where it cannot be renamed."""
    number = 1
    while (aside := path.with_name(f"{path.stem}.damaged-{number}{path.suffix}")).exists():
        number += 1
    try:
        path.rename(aside)
    except OSError:
        return None
    return aside
