"""Every error that a person can meet, in one place.

A message says what is wrong; `file` and `where` say in which file and where in
it; `remedy` says what to do. The command line prints these and nothing else.
The window says the same in the operator's language, by `code` and `values`.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path


class FruitguiError(Exception):
    """An error that is told to the operator, never shown as a traceback.

    Attributes:
        code: a stable word for programs, for example `bad_station`.
        what: what is wrong, one sentence.
        remedy: what to do about it, one sentence.
        file: the file concerned, if any.
        where: the place in it (a field, a line, a topic), if known.
        values: what else the sentence names (a sensor, a lot), for those who say it in other words.
    """

    exit_code = 1

    def __init__(
        self,
        code: str,
        what: str,
        remedy: str,
        *,
        file: Path | str | None = None,
        where: str | None = None,
        values: Mapping[str, object] | None = None,
    ) -> None:
        super().__init__(what)
        self.code = code
        self.what = what
        self.remedy = remedy
        self.file = None if file is None else str(file)
        self.where = where
        self.values = dict(values or {})

    def __reduce__(self) -> tuple[object, ...]:
        """Let the error cross to another process, whatever the arguments of its class are."""
        return _again, (type(self), self.args, self.__dict__)


def _again(kind: type[FruitguiError], args: tuple[object, ...], told: Mapping[str, object]) -> FruitguiError:
    error = kind.__new__(kind)
    error.args = args
    error.__dict__.update(told)
    return error


class InputError(FruitguiError):
    """The input cannot be used: a file, an option, a field."""

    exit_code = 2


class WorldError(FruitguiError):
    """Something outside the input failed: the disk, a device, another program."""

    exit_code = 1


class CancelledByUserError(FruitguiError):
    """The person stopped the job; nothing was left half-written."""

    exit_code = 130

    def __init__(self) -> None:
        super().__init__("cancelled", "Stopped on request.", "Start again when ready.")
