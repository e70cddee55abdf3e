"""How much room the disk has left, looked at now and then."""

from __future__ import annotations

import math
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Protocol

from fruitgui.errors import WorldError

LOOK_EVERY_S = 0.5


class Usage(Protocol):
    """What a disk says of itself."""

    @property
    def free(self) -> int:
        """Bytes that are free."""


DiskUsage = Callable[[Path], Usage]


class DiskWatch:
    """Watches the disk that a folder is on.

    Args:
        folder: on the disk.
        reserve_bytes: what shall stay free.
        usage: asks the disk.
    """

    def __init__(self, folder: Path, reserve_bytes: int, usage: DiskUsage = shutil.disk_usage) -> None:
        self._folder = folder
        self._reserve_bytes = reserve_bytes
        self._usage = usage
        self._looked_s = -math.inf
        self._room_bytes = 0

    def room_bytes(self, now_s: float) -> int:
        """Return what may still be used, at most half a second old; 0 where the disk does not answer any more.

        Args:
            now_s: the host's monotonic clock.
        """
        if now_s - self._looked_s >= LOOK_EVERY_S:
            self._looked_s = now_s
            try:
                self._room_bytes = max(self._usage(self._folder).free - self._reserve_bytes, 0)
            except OSError:
                self._room_bytes = 0
        return self._room_bytes

    def check(self, now_s: float) -> None:
        """Raise `WorldError` where there is no room even to begin."""
        if self.room_bytes(now_s) <= 0:
            raise WorldError(
                "disk_full",
                f"The disk of {self._folder} has less than {self._reserve_bytes / 1e9:.1f} GB free.",
                "Make room on it, or record to another disk.",
                file=self._folder,
            )
