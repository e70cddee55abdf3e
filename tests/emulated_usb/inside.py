"""`python -m tests.emulated_usb.inside MODULE TEST FOLDER`: runs one test on the emulated bus; nothing may be left."""

from __future__ import annotations

import faulthandler
import importlib
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path

from tests.emulated_usb.emulation import Emulation

LONGEST_S = 1400.0
_LEFT_S = 20.0


def run(module: str, test: str, folder: Path) -> int:
    """Run a test; return 0 where it passed and nothing was left over."""
    faulthandler.dump_traceback_later(LONGEST_S, exit=True)
    troubles: list[str] = []
    sys.unraisablehook = lambda what: troubles.append(f"{what.err_msg}: {what.exc_value!r} in {what.object!r}")
    threading.excepthook = lambda what: troubles.append(f"{what.thread}: {what.exc_value!r}")
    usb = Emulation()
    getattr(importlib.import_module(module), test).inside(usb, folder)
    _until(lambda: threading.active_count() == 1)
    _until(lambda: usb.left_open[0] == 0 and usb.left_open[2] == 0)
    left = [thread.name for thread in threading.enumerate() if thread is not threading.main_thread()]
    troubles += [f"a thread is left over: {name}" for name in left]
    if usb.left_open[0] or usb.left_open[2]:
        troubles.append(f"USB handles and transfers are left over: {usb.left_open}")
    print("\n".join(troubles))  # noqa: T201 - for the process outside
    faulthandler.cancel_dump_traceback_later()
    return 1 if troubles else 0


def _until(true: Callable[[], bool]) -> None:
    end_s = time.monotonic() + _LEFT_S
    while not true() and time.monotonic() < end_s:
        time.sleep(0.01)


if __name__ == "__main__":
    sys.exit(run(sys.argv[1], sys.argv[2], Path(sys.argv[3])))
