"""Starts processes whose USB bus is emulated; as a program it prints the stand-in's path."""

from __future__ import annotations

import hashlib
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pytest

from tests.emulated_usb.emulation import Emulation

SOURCE = Path(__file__).with_name("emulated_usb.c")
ROOT = Path(__file__).parents[2]
LONGEST_S = 1500.0

Inside = Callable[[Emulation, Path], None]

alone = pytest.mark.xdist_group("emulated USB")
"""Devices keep their own time: tests with them run one after the other, and leave a core to each."""


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
    return alone(outside)


class Command:
    """A command of fruitgui that runs among emulated Kinects; what it writes is taken in at its end.

    Args:
        script: see `python -m tests.emulated_usb`.
        arguments: of fruitgui.
    """

    def __init__(self, script: Mapping[str, Any], *arguments: str) -> None:
        hears, self._says = os.pipe()
        command = [sys.executable, "-m", "tests.emulated_usb", json.dumps({**script, "control_fd": hears}), *arguments]
        self.process = subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            env=environment(), pass_fds=(hears,), start_new_session=True,
        )  # fmt: skip
        os.close(hears)

    def happen(self, what: str, kinect: int = 0, value: float = 1.0) -> None:
        """Let a fault happen now."""
        os.write(self._says, json.dumps({"what": what, "kinect": kinect, "value": value}).encode() + b"\n")

    def end(self) -> subprocess.CompletedProcess[str]:
        """Wait for its end; return what it wrote."""
        try:
            out, err = self.process.communicate(timeout=LONGEST_S)
        finally:
            self.process.kill()
            os.close(self._says)
        return subprocess.CompletedProcess(self.process.args, self.process.returncode, out, err)


def run_command(script: Mapping[str, Any], *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run a command of fruitgui among emulated Kinects to its end."""
    return Command(script, *arguments).end()


if __name__ == "__main__":
    print(built())  # noqa: T201 - for LD_PRELOAD
