"""A line's folder has one window at a time."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from fruitgui.errors import WorldError
from fruitgui.station.holding import NAME, hold

HOLDS = """
import sys, time
from pathlib import Path
from fruitgui.station.holding import hold
held = hold(Path(sys.argv[1]))
print("held", flush=True)
time.sleep(60)
"""


def test_a_folder_that_another_process_holds_is_said_and_is_free_once_that_is_killed(tmp_path: Path) -> None:
    with subprocess.Popen([sys.executable, "-c", HOLDS, str(tmp_path)], stdout=subprocess.PIPE) as other:
        assert other.stdout is not None
        assert other.stdout.readline() == b"held\n"
        with pytest.raises(WorldError) as raised:
            hold(tmp_path)
        other.kill()
    assert (raised.value.code, raised.value.file) == ("line_open", str(tmp_path))
    hold(tmp_path).let_go()


def test_what_was_let_go_can_be_held_again(tmp_path: Path) -> None:
    held = hold(tmp_path)
    with pytest.raises(WorldError):
        hold(tmp_path)
    held.let_go()
    held.let_go()
    hold(tmp_path).let_go()
    assert os.listdir(tmp_path) == [NAME]  # noqa: PTH208 - names are enough


def test_a_folder_that_cannot_be_held_is_no_reason_not_to_open_it(tmp_path: Path) -> None:
    hold(tmp_path / "missing").let_go()
    (tmp_path / NAME).mkdir()
    hold(tmp_path).let_go()
