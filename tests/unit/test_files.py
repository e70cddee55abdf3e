from __future__ import annotations

import os
import stat
from pathlib import Path

import pytest

from fruitgui.errors import InputError, WorldError
from fruitgui.files import read_json, write_json, written_whole


def test_a_failure_in_the_middle_leaves_the_old_file_and_nothing_else(tmp_path: Path) -> None:
    path = tmp_path / "a.json"
    path.write_text("old")
    with pytest.raises(ZeroDivisionError), written_whole(path) as beside:  # noqa: PT012
        beside.write_text("half")
        raise ZeroDivisionError
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_a_whole_file_replaces_the_old_one_with_usual_rights(tmp_path: Path) -> None:
    path = tmp_path / "a.json"
    other = tmp_path / "b"
    other.write_text("x")
    with written_whole(path) as beside:
        beside.write_text("new")
    assert path.read_text() == "new"
    assert stat.S_IMODE(path.stat().st_mode) == stat.S_IMODE(other.stat().st_mode)


def test_a_missing_folder_is_said_plainly(tmp_path: Path) -> None:
    with pytest.raises(WorldError) as caught, written_whole(tmp_path / "no" / "a"):
        pass
    assert caught.value.file


def test_a_device_is_never_replaced(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    with pytest.raises(WorldError), written_whole(pipe):
        pass
    assert pipe.is_fifo()


def test_a_link_stays_a_link(tmp_path: Path) -> None:
    real, link = tmp_path / "real", tmp_path / "link"
    real.write_text("old")
    link.symlink_to(real)
    with written_whole(link) as beside:
        beside.write_text("new")
    assert link.is_symlink()
    assert real.read_text() == "new"


def test_a_name_of_bytes_that_are_no_text_comes_back_as_it_was(tmp_path: Path) -> None:
    value = {"recording": os.fsdecode(b"citr\xf3n.mcap"), "kind": "limón"}
    write_json(tmp_path / "a.json", value)
    assert read_json(tmp_path / "a.json") == value


def test_json_errors_name_line_and_column(tmp_path: Path) -> None:
    path = tmp_path / "a.json"
    path.write_text('{\n  "a": ]\n}')
    with pytest.raises(InputError) as caught:
        read_json(path)
    assert caught.value.where == "line 2, column 8"


def test_a_name_that_is_too_long_is_told(tmp_path: Path) -> None:
    with pytest.raises(WorldError) as caught, written_whole(tmp_path / ("a" * 3000)):
        pass
    assert caught.value.code == "cannot_write"
    assert list(tmp_path.iterdir()) == []
