"""`python -m tests.shift --minutes 60 --seed 1`: a shift on emulated Kinects; says what came of it."""

from __future__ import annotations

import argparse
import dataclasses
import json
import os
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

from tests.emulated_usb.outside import environment


def main() -> int:
    """Run a shift in a process with an emulated bus; return 1 where a count is wrong or a mishap untold."""
    parser = argparse.ArgumentParser(prog="python -m tests.shift", description=__doc__)
    parser.add_argument("--minutes", type=float, default=60.0, help="of the devices' time")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    if "LD_PRELOAD" not in os.environ:
        command = [sys.executable, "-m", "tests.shift", "--minutes", str(options.minutes), "--seed", str(options.seed)]
        return subprocess.run(command, env=environment(), check=False).returncode
    from tests.emulated_usb.emulation import Emulation
    from tests.shift.shift import run

    with tempfile.TemporaryDirectory() as folder:
        outcome = run(Emulation(), 60.0 * options.minutes, options.seed, Path(folder))
    said = dataclasses.asdict(outcome)
    said["happened"] = Counter(one.what for one in outcome.happened)
    json.dump(said, sys.stdout, indent=2)
    print()  # noqa: T201
    return int(bool(outcome.count.missed or outcome.count.twice or outcome.count.strange or outcome.unsaid))


if __name__ == "__main__":
    sys.exit(main())
