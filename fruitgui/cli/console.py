"""What the command line says, and where: results to standard output, all else to standard error."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Protocol

from fruitgui.errors import FruitguiError


class Reason(Protocol):
    """Why something was refused, and what to do."""

    @property
    def code(self) -> str:
        """A stable word."""

    @property
    def sensors(self) -> Iterable[str]:
        """The sensors concerned."""

    @property
    def what(self) -> str:
        """What was seen."""

    @property
    def remedy(self) -> str:
        """What to do."""


@dataclass(slots=True)
class Console:
    """Speaks to a person, or to a program where `json` was asked for.

    Attributes:
        as_json: standard output holds one JSON object and nothing else.
    """

    as_json: bool = False
    _progress_shown: bool = False

    def say(self, text: str) -> None:
        """Print a line for a person; silent where a program listens."""
        if not self.as_json:
            self._clear_progress()
            sys.stdout.write(text + "\n")

    def result(self, value: dict[str, Any]) -> None:
        """Print the one JSON object, where it was asked for."""
        if self.as_json:
            self._clear_progress()
            json.dump(value, sys.stdout, allow_nan=False)  # in ASCII: right whatever the terminal speaks
            sys.stdout.write("\n")
            sys.stdout.flush()

    def warn(self, texts: Iterable[str]) -> None:
        """Print warnings to standard error."""
        self._clear_progress()
        for text in texts:
            sys.stderr.write(f"warning: {text}\n")

    def error(self, error: FruitguiError) -> None:
        """Print an error: to standard error, and as JSON where asked for."""
        self._clear_progress()
        place = "" if error.where is None else f" [{error.where}]"
        sys.stderr.write(f"fruitgui: {error.what}{place}\n")
        if error.remedy:
            sys.stderr.write(f"  {error.remedy}\n")
        self.result({"error": error_value(error)})

    def refused(self, reasons: Iterable[Reason]) -> None:
        """Print why a calibration was refused, to standard error."""
        self._clear_progress()
        for reason in reasons:
            sensors = ", ".join(reason.sensors)
            sys.stderr.write(f"refused ({reason.code}; {sensors}): {reason.what}\n  {reason.remedy}\n")

    def progress(self, fraction: float, doing: str) -> None:
        """Show how far a job is, on a terminal only."""
        if sys.stderr.isatty():
            filled = round(20 * min(max(fraction, 0.0), 1.0))
            sys.stderr.write(f"\r\x1b[K[{'#' * filled}{'.' * (20 - filled)}] {doing}")
            sys.stderr.flush()
            self._progress_shown = True

    def _clear_progress(self) -> None:
        if self._progress_shown:
            sys.stderr.write("\r\x1b[K")
            self._progress_shown = False


def error_value(error: FruitguiError) -> dict[str, str | None]:
    """Return an error as the contract's JSON."""
    return {
        "code": error.code,
        "file": error.file,
        "where": error.where,
        "what": error.what,
        "remedy": error.remedy,
    }
