"""RealSense through the real SDK, playing files that its own software device recorded."""

from __future__ import annotations

import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

CHECKS = ("contract", "bit_exact", "units", "registration", "absent")
LONGEST_S = 300.0


@pytest.mark.parametrize("check", CHECKS)
def test_realsense(check: str, tmp_path: Path) -> None:
    """The SDK has its own libusb and its own threads: it runs in a process of its own."""
    if find_spec("pyrealsense2") is None:
        pytest.skip("the extra fruitgui[realsense] is not installed")
    command = [sys.executable, "-W", "error", "-m", "tests.unit.sensors.realsense_file", check, str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=LONGEST_S)
    assert done.returncode == 0, f"{done.stdout}\n{done.stderr}"
