"""Runs the product's command line as a person's script would: a process of its own, JSON back."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import threading
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

_MARK = "\npeak-kB "
# The kernel counts the parent's memory in what wait4 tells; the process's own account does not.
_WATCHED = f"""
import sys
from pathlib import Path
from fruitgui.cli import main
code = main(sys.argv[1:])
own = Path("/proc/self/status")
lines = own.read_text().splitlines() if own.exists() else []
peak = [line.split()[1] for line in lines if line.startswith("VmHWM")]
sys.stderr.write({_MARK!r} + (peak[0] if peak else "0"))
sys.exit(code)
"""


@dataclass(frozen=True, slots=True)
class Outcome:
    """How a command ended.

    Attributes:
        value: the JSON object on standard output, None where there was none.
        peak_mb: largest resident memory of the process. cpu_s: its processor time.
    """

    code: int
    value: dict[str, Any] | None
    stdout: str
    stderr: str
    wall_s: float
    cpu_s: float
    peak_mb: float


def fruitgui(*arguments: str | Path, cwd: Path | None = None, timeout_s: float = 1200.0) -> Outcome:
    """Run a command with `--json`."""
    command = [sys.executable, "-c", _WATCHED, *map(str, arguments), "--json"]
    environment = os.environ | {"PYTHONPATH": str(Path(__file__).resolve().parents[2])}
    began = time.monotonic()
    with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as err:
        process = subprocess.Popen(command, stdout=out, stderr=err, cwd=cwd, env=environment)
        stop = threading.Timer(timeout_s, process.kill)
        stop.start()
        # wait4 and not wait: it tells the memory and the time of this one process.
        _, status, used = os.wait4(process.pid, 0)
        stop.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        err.seek(0)
        said, (told, _, peak_kb) = out.read(), err.read().rpartition(_MARK)
        # A process that was killed or broke says nothing of its memory.
        told, peak_kb = (told, peak_kb) if peak_kb.isdigit() else (told + peak_kb, "0")
    return Outcome(process.returncode, _object(said), said, told, time.monotonic() - began,
                   used.ru_utime + used.ru_stime, int(peak_kb or 0) / 1024.0)  # fmt: skip


def require(outcome: Outcome, *codes: int) -> dict[str, Any]:
    """Return the JSON object of a command that ended with one of `codes`."""
    if outcome.code not in codes or outcome.value is None or "Traceback" in outcome.stderr:
        raise ProductFailedError(outcome)
    return outcome.value


class ProductFailedError(Exception):
    """A command ended as it never should."""

    def __init__(self, outcome: Outcome) -> None:
        super().__init__(f"exit {outcome.code}: {outcome.stdout[-600:]} {outcome.stderr[-1500:]}")


def _object(text: str) -> dict[str, Any] | None:
    try:
        value = json.loads(text)
    except json.JSONDecodeError:
        return None
    return value if isinstance(value, dict) else None
