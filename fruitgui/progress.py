"""How long jobs report and are stopped: two plain callables."""

from __future__ import annotations

from collections.abc import Callable

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
