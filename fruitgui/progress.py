"""How long jobs report and are stopped: two plain callables."""

from __future__ import annotations

import contextlib
import signal
from collections.abc import Callable, Iterator

from fruitgui.errors import CancelledByUserError

Progress = Callable[[float, str], None]
"""Called with the fraction done (0–1) and one line on what is being done."""

Cancelled = Callable[[], bool]
"""Asked between steps; true means: stop now, leave nothing behind."""


def no_progress(_fraction: float, _doing: str) -> None:
    """Ignore progress."""


def never_cancelled() -> bool:
    """Go on."""
    return False


def stop_if(cancelled: Cancelled) -> None:
    """Raise `CancelledByUserError` if the job was cancelled."""
    if cancelled():
        raise CancelledByUserError


@contextlib.contextmanager
def deaf_children() -> Iterator[None]:
    """Let processes that are started inside hear no interrupt from the keyboard.

    It reaches every process of a terminal, even those that are only just loading; it is the one that started them
    that ends them.
    """
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    from multiprocessing import resource_tracker

    resource_tracker.ensure_running()  # it would open our ears when it starts
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
