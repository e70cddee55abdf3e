"""Recordings made whole: what is saved, what is said, and what leaves no file."""

from __future__ import annotations

from pathlib import Path

import pytest

from fruitgui.errors import InputError
from fruitgui.station.recover_job import recover_recording
from tests.unit.sensors import ros_files as ros


def frames(count: int) -> list[ros.Message]:
    return [message for n in range(count) for message in ros.frameset("k1", 5.0 + n / 10)]


def test_frames_that_were_saved_are_counted(tmp_path: Path) -> None:
    recorded = recover_recording(ros.write_mcap(tmp_path / "a.mcap", frames(4)), tmp_path / "out.mcap")
    assert recorded.frames == {"k1": 4}
    assert recorded.warnings() == []


def test_without_one_frame_nothing_is_written_and_what_was_there_stays(tmp_path: Path) -> None:
    lonely = [message for message in frames(4) if "depth" not in message.topic]
    path, out = ros.write_mcap(tmp_path / "a.mcap", lonely), tmp_path / "out.mcap"
    out.write_text("kept")
    with pytest.raises(InputError) as caught:
        recover_recording(path, out)
    assert caught.value.exit_code == 2
    assert out.read_text() == "kept"


def test_topics_of_other_names_are_saved_aloud(tmp_path: Path) -> None:
    from dataclasses import replace

    others = [replace(message, topic="/elsewhere" + message.topic) for message in frames(3)]
    recorded = recover_recording(ros.write_mcap(tmp_path / "a.mcap", others), tmp_path / "out.mcap")
    assert recorded.frames == {}
    assert "--topics" in recorded.warnings()[0]
    assert (tmp_path / "out.mcap").exists()
