"""The program's own process, `fruitgui` and `python -m fruitgui`: loads next to nothing before it can be stopped."""

from __future__ import annotations

import os
import signal
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from types import FrameType

INTERRUPTED = 130


class _InterruptedError(KeyboardInterrupt):
    """Stopped from outside.

    A plain KeyboardInterrupt that comes while Python makes a class or function from text, as it does for every
    dataclass, lets the process end by the signal and not by its exit code, even if it was caught (pythonrun.c).
    """


class _Ear:
    """Hears an interrupt, and a polite request to end, which is the same; what a parent switched off stays off.

    Attributes:
        heard: whether there was one: a library that was being loaded may have made something else of it.
    """

    def __init__(self) -> None:
        self.heard = False

    def listen(self) -> None:
        for number in (signal.SIGINT, signal.SIGTERM):
            if signal.getsignal(number) in (signal.default_int_handler, signal.SIG_DFL):
                signal.signal(number, self._hear)

    def _hear(self, _number: int, _frame: FrameType | None) -> None:
        self.heard = True
        raise _InterruptedError


def _prepare_streams() -> None:
    """Let what nobody reads go nowhere, and what the terminal cannot show be written as numbers.

    A stream that is closed would give its place to the next file that is opened.
    """
    if sys.stdout is None:
        sys.stdout = open(os.devnull, "w", encoding="utf-8")  # noqa: PTH123, SIM115 - for the rest of the process
    if sys.stderr is None:
        sys.stderr = open(os.devnull, "w", encoding="utf-8")  # noqa: PTH123, SIM115 - for the rest of the process
    if hasattr(sys.stdout, "reconfigure"):
        sys.stdout.reconfigure(errors="backslashreplace")


def _stopped() -> int:
    """Say so, as the command line would if it stood; return the exit code."""
    sys.stderr.write("fruitgui: Stopped on request.\n  Start again when ready.\n")
    if "--json" in sys.argv:
        sys.stdout.write(
            '{"error": {"code": "cancelled", "file": null, "where": null, "what": "Stopped on request.", '
            '"remedy": "Start again when ready."}}\n'
        )
    return INTERRUPTED


def main() -> int:
    """Run the command line; return its exit code."""
    ear = _Ear()
    try:
        ear.listen()
        _prepare_streams()
        from fruitgui.cli import main as run
    except KeyboardInterrupt:
        return _stopped()
    except ImportError:
        if ear.heard:
            return _stopped()
        raise
    try:
        return run()
    except KeyboardInterrupt:  # once more, while the command line told of the first
        return INTERRUPTED
    except Exception:
        if ear.heard:
            return _stopped()
        raise


if __name__ == "__main__":
    sys.exit(main())
