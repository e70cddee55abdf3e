"""Where frames of real sensors lie, for tests that use them; they are not part of the project."""

from __future__ import annotations

from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1].parent / "shared" / "data"


def real_data(name: str) -> Path:
    """Return the path of a real file or folder; skip the test where it is absent."""
    path = ROOT / name
    if not path.exists():
        pytest.skip(f"the real frames '{name}' are not on this machine")
    return path
