"""What goes wrong is written down: a log beside the line's files, with a trace even of a crash."""

from __future__ import annotations

import contextlib
import faulthandler
import logging
import sys
from collections.abc import Callable
from logging.handlers import RotatingFileHandler
from pathlib import Path
from types import TracebackType
from typing import TextIO

LOG = "fruitgui.log"
CRASH = "crash.log"
MOST_BYTES = 2_000_000

log = logging.getLogger(__name__)


class _LogFile(RotatingFileHandler):
    """A log that a full disk cannot take is let go: the window says what is wrong."""

    def handleError(self, record: logging.LogRecord) -> None:  # noqa: N802 - the library's name
        """Do nothing."""


class Logs:
    """The log files of one window; opened at the start, closed at the end."""

    def __init__(self, folder: Path) -> None:
        self.path = folder / LOG
        self._crash_path = folder / CRASH
        self._handler: _LogFile | None = None
        self._crash: TextIO | None = None
        self._hook = sys.excepthook

    def open(self, tell: Callable[[BaseException], None]) -> None:
        """Begin to write, and tell of what nobody caught. A log that cannot be written keeps no window from opening."""
        with contextlib.suppress(OSError):
            self._handler = _LogFile(self.path, maxBytes=MOST_BYTES, backupCount=2, encoding="utf-8")
            self._handler.setFormatter(logging.Formatter("%(asctime)s %(levelname)s %(name)s %(message)s"))
            logging.getLogger().addHandler(self._handler)
            logging.getLogger("fruitgui").setLevel(logging.INFO)
        with contextlib.suppress(OSError):
            self._crash = self._crash_path.open("a", encoding="utf-8")
            faulthandler.enable(self._crash)
        self._hook = sys.excepthook

        def hook(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
            log.critical("not caught", exc_info=(kind, error, trace))
            tell(error)

        sys.excepthook = hook

    def close(self) -> None:
        """Write no more."""
        sys.excepthook = self._hook
        if self._crash is not None:
            faulthandler.disable()
            self._crash.close()
            self._crash = None
        if self._handler is not None:
            logging.getLogger().removeHandler(self._handler)
            self._handler.close()
            self._handler = None
