"""Which programs hold a device: whoever has its node open."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from fruitgui.sensors.usb.machine import Machine, text_of

_NODE = re.compile(r"/dev/bus/usb/(\d{1,4})/(\d{1,4})", re.ASCII)


@dataclass(frozen=True, slots=True)
class Holder:
    """A running program.

    Attributes:
        pid: its number.
        program: its name.
    """

    pid: int
    program: str


Holders = Mapping[tuple[int, int], tuple[Holder, ...]]
"""By bus and address of the device."""


def read_holders(machine: Machine, own_pid: int) -> Holders:
    """Return who holds which device, this program left out.

    Programs of other people are seen by the administrator only; they are missing, never an error.
    """
    found: dict[tuple[int, int], tuple[Holder, ...]] = {}
    for process in _processes(machine.processes):
        if process.name == str(own_pid):
            continue
        for device in sorted(_held(process)):
            found[device] = (*found.get(device, ()), Holder(int(process.name), _program(process)))
    return found


def _processes(folder: Path) -> list[Path]:
    try:
        numbered = [one for one in folder.iterdir() if one.name.isascii() and one.name.isdigit() and len(one.name) < 10]
    except OSError:
        return []
    return sorted(numbered, key=lambda one: int(one.name))


def _held(process: Path) -> set[tuple[int, int]]:
    try:
        links = list((process / "fd").iterdir())
    except OSError:
        return set()
    held = set()
    for link in links:
        try:
            target = str(link.readlink())
        except OSError:
            continue  # it was closed meanwhile
        match = _NODE.fullmatch(target)
        if match is not None:
            held.add((int(match[1]), int(match[2])))
    return held


def _program(process: Path) -> str:
    return text_of(process / "comm")[:64] or "?"
