"""The core runs where Qt is not there."""

from __future__ import annotations

import os
import subprocess
import sys

BLOCKED = """
import importlib, pkgutil, sys

class NoQt:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in ("PySide6", "pyqtgraph", "shiboken6"):
            raise ModuleNotFoundError(f"{name} is blocked", name=name)

sys.meta_path.insert(0, NoQt())
import fruitgui
for module in pkgutil.walk_packages(fruitgui.__path__, "fruitgui."):
    parts = module.name.split(".")
    if "gui" not in parts and "migrations" not in parts and parts[-1] != "__main__":
        importlib.import_module(module.name)
from fruitgui.cli import main
sys.exit(main(["--version"]))
"""


def test_every_room_but_the_window_s_is_imported_without_qt() -> None:
    environment = {**os.environ, "PYTHONWARNINGS": "ignore"}
    done = subprocess.run(
        [sys.executable, "-c", BLOCKED], capture_output=True, text=True, env=environment, check=False, timeout=120
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("fruitgui ")
