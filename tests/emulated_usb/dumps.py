"""Dump folders as fakenect plays them: the driver library of the OpenKinect project that reads files for a Kinect.

`INDEX.txt` names the files in order; `d-HOST_S-TICKS.pgm` holds raw depth (little-endian, which no other reader of PGM
expects), `r-HOST_S-TICKS.ppm` RGB, `a-HOST_S-TICKS.dump` what the accelerometer felt.
"""

from __future__ import annotations

import struct
from collections.abc import Iterable
from pathlib import Path

from fruitgui.frame import U8, U16

LIBRARY = "/usr/lib/{}-linux-gnu/fakenect/libfreenect.so.0.5"


Recorded = tuple[float, int, U16, U8]
"""Host time in seconds, ticks, raw depth, RGB."""


def write_dump(folder: Path, frames: Iterable[Recorded], before_s: float = 0.0) -> None:
    """Write frames into a folder; for so long before the first of them only the accelerometer is heard, every 50 ms."""
    names: list[str] = []
    for host_s, ticks, raw, color in frames:
        if not names:
            names += _felt(folder, host_s, before_s)
        stamp = f"{host_s:f}-{ticks % 2**32}"
        (folder / f"r-{stamp}.ppm").write_bytes(b"P6 640 480 255\n" + color.tobytes())
        (folder / f"d-{stamp}.pgm").write_bytes(b"P5 640 480 65535\n" + raw.astype("<u2").tobytes())
        names += [f"r-{stamp}.ppm", f"d-{stamp}.pgm"]
    (folder / "INDEX.txt").write_text("\n".join(names) + "\n")


def _felt(folder: Path, until_s: float, for_s: float) -> list[str]:
    names = [f"a-{until_s - for_s + 0.05 * number:f}-0.dump" for number in range(round(for_s / 0.05))]
    for name in names:
        (folder / name).write_bytes(struct.pack("<hhhbxi", 0, 819, 0, 0, 0))
    return names
