"""Which format a recording is in."""

from __future__ import annotations

from pathlib import Path

from fruitgui.errors import InputError
from fruitgui.sensors.recordings.bag_file import BAG_MAGIC, BagFile
from fruitgui.sensors.recordings.mcap_file import McapFile
from fruitgui.sensors.recordings.raw import Container
from fruitgui.sensors.recordings.records import MAGIC

_REMEDY = "Name an MCAP file (ROS 2 messages) or a ROS 1 .bag."
_MATROSKA, _SQLITE = b"\x1aE\xdf\xa3", b"SQLite format 3\0"


def open_container(path: Path) -> Container:
    """Return the container of a recording, told by its first bytes.

    Raises:
        InputError: missing, not a file, not readable, empty, or of no known format.
    """
    try:
        if path.is_dir():
            raise InputError("not_a_file", f"{path} is a folder, not a recording.", _REMEDY, file=path)
        with path.open("rb") as file:
            start = file.read(16)
            file.seek(max(path.stat().st_size - len(MAGIC), 0))
            end = file.read(len(MAGIC))
        if start.startswith(MAGIC) or end == MAGIC:
            return McapFile(path)
        if start.startswith(BAG_MAGIC):
            return BagFile(path)
    except OSError as error:
        raise InputError(
            "cannot_read", f"Cannot read {path}: {error.strerror}.", "Check the name and that the file may be read.",
            file=path,
        ) from error  # fmt: skip
    if not start:
        raise InputError("empty_recording", f"{path} is empty.", "Record again, or name another file.", file=path)
    if start.startswith(_MATROSKA):
        raise InputError(
            "matroska", f"{path} is a Matroska video, as the Azure Kinect's recorder makes them.",
            "Reading its depth takes Microsoft's libk4arecord, which is not kept any more: play it through the "
            "Azure Kinect's ROS driver and record that as MCAP or .bag.", file=path,
        )  # fmt: skip
    if start.startswith(_SQLITE):
        raise InputError(
            "sqlite_recording", f"{path} is a ROS 2 recording in an SQLite file (.db3), not in MCAP.",
            f"Turn it into MCAP: rosbags-convert --src {path} --dst NEW_FOLDER --dst-storage mcap", file=path,
        )  # fmt: skip
    raise InputError("not_a_recording", f"{path} is not a recording that can be read.", _REMEDY, file=path)
