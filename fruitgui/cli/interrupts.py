"""The keyboard's interrupt as a wish to end well, for jobs that keep what they have done so far."""

from __future__ import annotations

import contextlib
import signal
import threading
from collections.abc import Iterator, Mapping
from types import FrameType

from fruitgui.progress import Cancelled

_SIGNALS = tuple(signal.Signals[name] for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name))
"""The keyboard, whoever ends programs, and a terminal that is closed."""


@contextlib.contextmanager
def ending_well() -> Iterator[Cancelled]:
    """Give what tells whether the person wants the job to end; a second interrupt ends it the hard way.

    Only the main thread hears signals; on any other this never tells.
    """
    asked = threading.Event()

    def hear(_number: int, _frame: FrameType | None) -> None:
        asked.set()
        listen(before)

    def listen(handlers: Mapping[signal.Signals, signal._HANDLER]) -> None:
        for number, handler in handlers.items():
            signal.signal(number, handler)

    if threading.current_thread() is not threading.main_thread():
        yield asked.is_set
        return
    before = {number: signal.getsignal(number) or signal.SIG_DFL for number in _SIGNALS}
    listen(dict.fromkeys(_SIGNALS, hear))
    try:
        yield asked.is_set
    finally:
        listen(before)
