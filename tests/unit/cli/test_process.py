"""The program as a process: stopped at any moment, told nothing can be said. No moment here depends on a clock."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from multiprocessing import get_context
from multiprocessing.connection import Connection
from pathlib import Path

import pytest

from fruitgui.progress import deaf_children

PROCESS = [sys.executable, "-m", "fruitgui"]

# Something that happens just when the command line is loaded.
MEANWHILE = """
import os, signal, sys
import fruitgui.__main__ as process

class Loading:
    def find_spec(self, name, path, target=None):
        if name == {name!r}:
            sys.meta_path.remove(self)
            {does}

sys.meta_path.insert(0, Loading())
sys.exit(process.main())
"""
STOP = "os.kill(os.getpid(), signal.SIGINT)"


def end(name: str, does: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    script = MEANWHILE.format(name=name, does=does)
    return subprocess.run([sys.executable, "-c", script, *arguments], capture_output=True, text=True, check=False)


@pytest.mark.parametrize("number", ["SIGINT", "SIGTERM"])
@pytest.mark.parametrize("name", ["fruitgui.cli", "fruitgui.station.source"])
def test_stopped_while_loading_it_ends_with_130_and_one_object(number: str, name: str, tmp_path: Path) -> None:
    does = f"os.kill(os.getpid(), signal.{number})"
    ended = end(name, does, "calibrate", "no.mcap", "--station", str(tmp_path / "s.json"), "--json")
    assert ended.returncode == 130
    assert json.loads(ended.stdout)["error"]["code"] == "cancelled"
    assert "Traceback" not in ended.stderr


def test_stopped_while_a_class_is_made_from_text_it_ends_with_its_exit_code() -> None:
    ended = end("fruitgui.cli", f'exec("{STOP}")', "run", "--json")
    assert ended.returncode == 130


@pytest.mark.parametrize("name", ["fruitgui.cli", "fruitgui.station.source"])
def test_an_interrupt_that_a_library_made_something_else_of_is_one_still(name: str, tmp_path: Path) -> None:
    does = f"""
            try:
                {STOP}
            except KeyboardInterrupt:
                raise ImportError("initialization failed") from None
"""
    ended = end(name, does, "calibrate", "no.mcap", "--station", str(tmp_path / "s.json"), "--json")
    assert ended.returncode == 130
    assert json.loads(ended.stdout)["error"]["code"] == "cancelled"
    assert "Traceback" not in ended.stderr


def tell_what_is_blocked(pipe: Connection) -> None:
    pipe.send(signal.SIGINT in signal.pthread_sigmask(signal.SIG_BLOCK, []))


def test_a_child_is_deaf_from_its_first_moment_and_its_parent_is_not() -> None:
    context = get_context("spawn")
    ours, theirs = context.Pipe()
    child = context.Process(target=tell_what_is_blocked, args=(theirs,))
    with deaf_children():
        child.start()
    assert ours.recv()
    child.join()
    assert signal.SIGINT not in signal.pthread_sigmask(signal.SIG_BLOCK, [])


@pytest.mark.parametrize("closed", [(1,), (2,), (1, 2)])
def test_closed_streams_are_no_trouble(closed: tuple[int, ...], tmp_path: Path) -> None:
    def close() -> None:
        for number in closed:
            os.close(number)

    command = [*PROCESS, "calibrate", "no.mcap", "--station", str(tmp_path / "s.json"), "--json"]
    ended = subprocess.run(command, capture_output=True, text=True, check=False, preexec_fn=close)
    assert ended.returncode == 2
    assert "Traceback" not in ended.stderr


@pytest.mark.parametrize("name", ["citrón.mcap".encode(), b"citr\xf3n.mcap"], ids=["text", "bytes"])
@pytest.mark.parametrize("form", [[], ["--json"]], ids=["lines", "json"])
def test_names_that_the_terminal_cannot_show_are_no_trouble(name: bytes, form: list[str], tmp_path: Path) -> None:
    command = [*PROCESS, "calibrate", os.fsdecode(name), "--station", os.fspath(tmp_path / "s.json"), *form]
    environment = os.environ | {"PYTHONIOENCODING": "ascii"}
    ended = subprocess.run(command, capture_output=True, check=False, env=environment)
    assert ended.returncode == 2
    assert b"Traceback" not in ended.stderr
    if form:
        assert json.loads(ended.stdout)["error"]["file"] == os.fsdecode(name)


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no device that is always full")
def test_an_output_that_takes_nothing_is_said_and_ends_with_1() -> None:
    with Path("/dev/full").open("w") as full:
        ended = subprocess.run([*PROCESS, "fly", "--json"], stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert ended.returncode == 1
    assert "Traceback" not in ended.stderr
    assert "refused" in ended.stderr
