"""What is dear to make and never changed is made once in a run of the tests, though several workers run them."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtCore import QLockFile


def made_once(factory: pytest.TempPathFactory, name: str, make: Callable[[Path], object]) -> Path:
    """Return the folder of this name that `make` filled, for whichever worker came first; only to be read."""
    run = factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        run = run.parent
    folder, beside = run / name, run / f"{name}-unfinished"
    lock = QLockFile(str(run / f"{name}.lock"))
    lock.setStaleLockTime(0)  # rendering takes as long as it takes
    assert lock.lock(), lock.error()
    try:
        if not folder.exists():
            shutil.rmtree(beside, ignore_errors=True)
            beside.mkdir()
            make(beside)
            beside.rename(folder)
    finally:
        lock.unlock()
    return folder
