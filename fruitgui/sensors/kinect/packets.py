"""What libfreenect's log tells: it hands on pictures with holes without a word, and gives no errors back."""

from __future__ import annotations

import re
from collections.abc import Sequence
from enum import StrEnum


class Stream(StrEnum):
    """What a picture is of."""

    DEPTH = "depth"
    VIDEO = "video"


_PICTURE = re.compile(r"Got (depth|video) frame of size \d+/\d+, (\d+)/(\d+) packets arrived")
_SHORT = re.compile(r"\[Stream (70|80)\] Expected \d+ data bytes, but got \d+")
_NUMBERS = {"70": Stream.DEPTH, "80": Stream.VIDEO}
_GONE = ("marked dead", "USB device disappeared", "USB camera marked dead")
_NO_ROOM = ("Failed to submit isochronous transfer", "Failed to allocate transfer")
_NOT_DONE = ("send_cmd:", "write_register:", "write_cmos_register:", "read_cmos_register:", "read_register:")
_ERROR = 1
_KEPT = 8


class PacketLog:
    """Reads the lines of one device's library context, in the thread that calls the library.

    Attributes:
        gone: the device was unplugged.
        no_room: transfers could not be placed on the bus: what is there already fills it.
        errors: the last things that went wrong, as the library says.
    """

    def __init__(self) -> None:
        self.gone = False
        self.no_room = False
        self._errors: list[str] = []
        self._whole = {Stream.DEPTH: True, Stream.VIDEO: True}
        self._short = {Stream.DEPTH: False, Stream.VIDEO: False}

    @property
    def errors(self) -> Sequence[str]:
        """The last things that went wrong."""
        return tuple(self._errors)

    def hear(self, level: int, line: str) -> None:
        """Take in a line."""
        picture = _PICTURE.search(line)
        if picture is not None:
            stream = Stream(picture[1])
            self._whole[stream] = picture[2] == picture[3] and not self._short[stream]
            self._short[stream] = False
            return
        short = _SHORT.search(line)
        if short is not None:
            self._short[_NUMBERS[short[1]]] = True
            return
        self.gone = self.gone or any(word in line for word in _GONE)
        self.no_room = self.no_room or any(word in line for word in _NO_ROOM)
        if level <= _ERROR or any(word in line for word in _NO_ROOM):
            self._errors = [*self._errors, line.strip()][-_KEPT:]

    def is_whole(self, stream: Stream) -> bool:
        """Tell whether all packets of a stream's newest picture arrived whole; true where the log says nothing."""
        return self._whole[stream]

    def forget(self) -> None:
        """Let go of what went wrong up to now."""
        self.no_room = False
        self._errors = []

    def not_done(self) -> bool:
        """Tell whether the device refused or did not get an order since the last `forget`."""
        return any(line.startswith(_NOT_DONE) for line in self._errors)
