"""Scripts on a screen of their own that has OpenGL."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

NO_GL = 77
"""A script's exit code where the screen has no OpenGL."""


def run_on_screen(script: str, folder: Path) -> None:
    """Run a script on such a screen; the test is left out where there is none, and fails where the script does."""
    xvfb = shutil.which("xvfb-run")
    if xvfb is None:
        pytest.skip("no Xvfb here")
    path = folder / "look.py"
    path.write_text(script)
    environment = {**os.environ, "QT_QPA_PLATFORM": "xcb", "LIBGL_ALWAYS_SOFTWARE": "1"}
    done = subprocess.run(
        [xvfb, "-a", "-s", "-screen 0 800x600x24", sys.executable, str(path)],
        capture_output=True, text=True, env=environment, check=False, timeout=120,
    )  # fmt: skip
    if done.returncode == NO_GL:
        pytest.skip("no OpenGL here")
    assert done.returncode == 0, done.stderr[-2000:]
