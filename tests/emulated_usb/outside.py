"""Starts processes whose USB bus is emulated."""

from __future__ import annotations

import hashlib
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

from tests.emulated_usb.emulation import Emulation

SOURCE = Path(__file__).with_name("emulated_usb.c")
ROOT = Path(__file__).parents[2]
LONGEST_S = 300.0

Inside = Callable[[Emulation, Path], None]


def built() -> Path:
    """Return the stand-in for libusb, built once for each version of its source."""
    digest = hashlib.sha256(SOURCE.read_bytes()).hexdigest()[:16]
    library = Path(tempfile.gettempdir()) / f"fruitgui_emulated_usb_{os.getuid()}" / f"emulated_usb_{digest}.so"
    if not library.exists():
        library.parent.mkdir(mode=0o700, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=library.parent) as folder:
            made = Path(folder) / "made.so"
            command = ["gcc", "-O2", "-shared", "-fPIC", "-I/usr/include/libusb-1.0", "-o", str(made), str(SOURCE)]
            subprocess.run([*command, "-lpthread"], check=True, timeout=LONGEST_S)
            made.replace(library)
    return library


def environment() -> dict[str, str]:
    """Return the environment of a process whose USB bus is emulated."""
    path = os.pathsep.join(part for part in (str(ROOT), os.environ.get("PYTHONPATH", "")) if part)
    return {**os.environ, "LD_PRELOAD": str(built()), "PYTHONPATH": path, "PYTHONFAULTHANDLER": "1"}


def inside(test: Inside) -> Callable[[Path], None]:
    """Let a test run in a process of its own whose USB bus is emulated."""

    def outside(tmp_path: Path) -> None:
        where = [sys.executable, "-W", "error", "-m", "tests.emulated_usb.inside", test.__module__, test.__name__]
        done = subprocess.run(
            [*where, str(tmp_path)],
            capture_output=True, text=True, check=False, env=environment(), cwd=ROOT, timeout=LONGEST_S,
        )  # fmt: skip
        assert done.returncode == 0, f"{done.stdout}\n{done.stderr}"

    outside.__name__, outside.__doc__, outside.__module__ = test.__name__, test.__doc__, test.__module__
    outside.inside = test  # type: ignore[attr-defined]  # found there by the other process
    return outside


def start_command(script: dict[str, Any], *arguments: str, **options: Any) -> subprocess.Popen[str]:  # noqa: ANN401
    """Start a command of fruitgui among emulated Kinects; options are those of `subprocess.Popen`."""
    command = [sys.executable, "-m", "tests.emulated_usb", json.dumps(script), *arguments]
    streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True, "env": environment()}
    return subprocess.Popen(command, **{**streams, **options})


def run_command(script: dict[str, Any], *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run a command of fruitgui among emulated Kinects to its end."""
    with start_command(script, *arguments) as process:
        try:
            out, err = process.communicate(timeout=LONGEST_S)
        except subprocess.TimeoutExpired:
            process.kill()
            raise
    return subprocess.CompletedProcess(process.args, process.returncode, out, err)
