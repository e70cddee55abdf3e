"""A cut or damaged recording made whole again."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from fruitgui.errors import InputError
from fruitgui.files import written_whole
from fruitgui.sensors.recordings.container import open_container
from fruitgui.sensors.recordings.mcap_file import McapFile
from fruitgui.sensors.recordings.raw import MalformedError
from fruitgui.sensors.recordings.records import CHANNEL, MESSAGE, SCHEMA, Fields
from fruitgui.sensors.recordings.tally import lost_text

_CHUNK_BYTES = 4 * 1024 * 1024


@dataclass(frozen=True, slots=True)
class Recovered:
    """What was saved.

    Attributes:
        messages: how many were written.
        bytes_unread: of the cut file, after the place where it stopped being sound.
        damaged: parts before that place that were left out, by cause.
        lost: what was in them, in words; empty where nothing was, or nothing is known.
    """

    messages: int
    bytes_unread: int
    damaged: dict[str, int]
    lost: str = ""


def recover(cut: Path | str, out: Path | str) -> Recovered:
    """Write everything sound of a cut MCAP file, message by message as it stands, into a whole one.

    Raises:
        InputError: not an MCAP file, nothing in it is sound, or `out` is `cut`.
        WorldError: `out` cannot be written.
    """
    cut, out = Path(cut), Path(out)
    source = open_container(cut)
    if not isinstance(source, McapFile):
        raise InputError(
            "not_mcap", f"{cut} is a ROS 1 bag; only MCAP files are recovered.", "Use the bag as it is: a cut one is "
            "read as far as it is sound.", file=cut,
        )  # fmt: skip
    if out.exists() and out.samefile(cut):
        raise InputError(
            "same_file", f"{out} is the file that is to be recovered.", "Name another file to write to.", file=out
        )
    with written_whole(out) as beside, beside.open("wb") as file:
        messages = _copy(source, file)
        if not messages:
            raise InputError(
                "no_message", f"{cut} holds not one whole message.", "Nothing can be saved from it; record again.",
                file=cut,
            )  # fmt: skip
    soundness = source.soundness
    return Recovered(messages, soundness.bytes_unread, soundness.damaged, lost_text(soundness))


def _copy(source: McapFile, file: Any) -> int:  # noqa: ANN401 - a binary file, as the writer of mcap wants it
    from mcap.writer import CompressionType, Writer

    writer = Writer(file, chunk_size=_CHUNK_BYTES, compression=CompressionType.ZSTD)
    writer.start(profile="ros2", library="fruitgui")
    copier = _Copier(writer)
    for opcode, record in source.records():
        try:
            copier.copy(opcode, record)
        except MalformedError as error:
            source.soundness.skip(str(error))
    writer.finish()
    return copier.messages


class _Copier:
    """Copies records, giving schemas and channels the ids of the new file."""

    def __init__(self, writer: Any) -> None:  # noqa: ANN401 - mcap has no stubs here
        self._writer = writer
        self._schemas: dict[int, int] = {0: 0}
        self._channels: dict[int, int] = {}
        self.messages = 0

    def copy(self, opcode: int, record: memoryview) -> None:
        fields = Fields(record)
        if opcode == SCHEMA:
            old, name, encoding = fields.number("H"), fields.text(), fields.text()
            if old not in self._schemas:
                self._schemas[old] = self._writer.register_schema(name, encoding, fields.octets())
        elif opcode == CHANNEL:
            old, schema, topic, encoding = fields.number("H"), fields.number("H"), fields.text(), fields.text()
            if old not in self._channels:
                schema_id = self._schemas.get(schema, 0)
                self._channels[old] = self._writer.register_channel(topic, encoding, schema_id, fields.table())
        elif opcode == MESSAGE:
            self._message(fields)
        else:
            name = fields.text()
            self._writer.add_metadata(name, fields.table())

    def _message(self, fields: Fields) -> None:
        channel, sequence = self._channels.get(fields.number("H")), fields.number("I")
        log_time, publish_time = fields.number("Q"), fields.number("Q")
        if channel is not None:
            self._writer.add_message(channel, log_time, fields.rest(), publish_time, sequence)
            self.messages += 1
