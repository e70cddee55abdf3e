"""Where the system tells of itself: one folder, so that another system, or a made one, can be looked at."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

SYSTEM = Path("/")
MOST_BYTES = 4096
"""No attribute of sysfs is longer than a page."""


def may_use(node: Path) -> bool:
    """Tell whether this person may read and write a device's node."""
    return os.access(node, os.R_OK | os.W_OK)


@dataclass(frozen=True, slots=True)
class Machine:
    """A Linux system as its files show it.

    Attributes:
        root: the folder below which `sys`, `proc`, `dev` and `etc` lie.
        usable: tells whether this person may use a node below `dev`.
    """

    root: Path = SYSTEM
    usable: Callable[[Path], bool] = may_use

    @property
    def is_this(self) -> bool:
        """Whether it is the system that runs."""
        return self.root == SYSTEM

    @property
    def usb_devices(self) -> Path:
        """The folder in which every USB device and interface has an entry."""
        return self.root / "sys/bus/usb/devices"

    @property
    def usbfs_memory(self) -> Path:
        """The file that says how many MB all programs together may hold for USB transfers; 0 is without limit."""
        return self.root / "sys/module/usbcore/parameters/usbfs_memory_mb"

    @property
    def processes(self) -> Path:
        """The folder of running programs."""
        return self.root / "proc"

    def node(self, bus: int, address: int) -> Path:
        """Return the node through which a device is used."""
        return self.root / f"dev/bus/usb/{bus:03d}/{address:03d}"


def text_of(path: Path) -> str:
    """Return a file's first page as one printable line; empty where it cannot be read."""
    try:
        with path.open("rb") as file:
            raw = file.read(MOST_BYTES)
    except (OSError, ValueError):  # ValueError: a name with a zero byte in it
        return ""
    line = raw.decode("utf-8", errors="replace").strip().partition("\n")[0]
    return "".join(one for one in line if one.isprintable()).strip()


def number_of(path: Path, base: int = 10) -> int | None:
    """Return a file's whole number, not negative; None where it holds none."""
    text = text_of(path)
    try:
        value = int(text, base)
    except ValueError:
        return None
    return value if 0 <= value < 2**31 else None
