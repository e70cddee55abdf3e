"""The product's binding on a second, independent library: Debian's fakenect, which plays files for a Kinect."""

from __future__ import annotations

import hashlib
import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from fruitgui.sensors.kinect.clock import FRAME_TICKS
from fruitgui.sensors.kinect.depth_table import ZeroPlane, depth_table
from tests.emulated_usb import pictures
from tests.emulated_usb.dumps import write_dump
from tests.emulated_usb.outside import alone

pytestmark = alone

ROOT = Path(__file__).parents[4]
COUNT = 20
BEGIN = 2**32 - 10 * FRAME_TICKS


@pytest.fixture(scope="module")
def dump(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("dump")
    frames = ((1000 + count / 30, BEGIN + count * FRAME_TICKS, depth(count), color(count)) for count in range(COUNT))
    write_dump(folder, frames, before_s=3.0)
    return folder


def depth(count: int) -> np.ndarray[Any, np.dtype[np.uint16]]:
    return pictures.noise(count) if count % 2 else pictures.level(500 + 10 * count)


def color(count: int) -> np.ndarray[Any, np.dtype[np.uint8]]:
    return np.random.default_rng(1000 + count).integers(0, 256, (480, 640, 3), dtype=np.uint8)


def played(dump: Path, how: str) -> list[Any]:
    done = subprocess.run(
        [sys.executable, "-m", "tests.unit.sensors.kinect.play_dump", how],
        capture_output=True, text=True, check=False, cwd=ROOT, timeout=120,
        env={**os.environ, "FAKENECT_PATH": str(dump), "PYTHONPATH": str(ROOT)},
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    came: list[Any] = json.loads(done.stderr)
    return came


def digest(pixels: np.ndarray[Any, Any]) -> str:
    return hashlib.blake2b(pixels.tobytes()).hexdigest()


def test_every_picture_arrives_as_it_is_with_its_stamp(dump: Path) -> None:
    wanted = []
    for count in range(COUNT):
        stamp = (BEGIN + count * FRAME_TICKS) % 2**32
        wanted += [["video", stamp, digest(color(count)), True], ["depth", stamp, digest(depth(count)), True]]
    assert played(dump, "raw") == wanted


def test_frames_come_in_order_through_the_clock_s_wrap(dump: Path) -> None:
    came = played(dump, "frames")
    numbers, times, deepest, colors, damaged = (list(column) for column in zip(*came, strict=True))
    counts = {digest(color(count)): count for count in range(COUNT)}
    seen = [counts[one] for one in colors]
    # a host that is busy misses some: the library plays on, and their numbers are missing
    assert len(seen) >= 2
    assert (np.diff(seen) > 0).all()
    assert np.diff(numbers).tolist() == np.diff(seen).tolist()
    assert (np.diff(times) > 0).all()
    assert not any(damaged)
    table = depth_table(ZeroPlane())
    assert all(mm == table[500 + 10 * count] for mm, count in zip(deepest, seen, strict=True) if count % 2 == 0)
