"""What is sound of a cut or damaged recording, written to a good one."""

from __future__ import annotations

import contextlib
from collections import Counter
from pathlib import Path

from fruitgui.errors import InputError
from fruitgui.progress import Progress, no_progress
from fruitgui.sensors.recordings import open_recording, recover
from fruitgui.station.record_state import Recorded


def recover_recording(cut: Path, out: Path, progress: Progress = no_progress) -> Recorded:
    """Write everything sound of a cut recording into a good one.

    Raises:
        InputError: nothing in it can be read, or not one frame; then nothing is written.
        WorldError: the file cannot be written.
    """
    progress(0.0, f"Reading {cut.name}")
    foreign = _is_foreign(cut)
    saved = recover(cut, out)
    warnings = [f"{saved.bytes_unread} bytes at the end of {cut} could not be used."] if saved.bytes_unread else []
    warnings += [f"{count} damaged parts were left out: {cause}." for cause, count in saved.damaged.items()]
    if saved.lost:
        warnings.append(f"{cut.name}: {saved.lost}.")
    frames: Counter[str] = Counter()
    times_s: list[float] = []
    if foreign:
        warnings.append(f"{out} holds {saved.messages} messages; name the topics of its sensors with --topics.")
        return Recorded((out,), {}, 0.0, notes=tuple(warnings))
    for time_s, frame in open_recording(out).frames():
        frames[frame.sensor] += 1
        times_s.append(time_s)
    lasted_s = max(times_s, default=0.0) - min(times_s, default=0.0)
    return Recorded((out,), dict(frames), lasted_s, notes=tuple(warnings), bytes_written=out.stat().st_size)


def _is_foreign(path: Path) -> bool:
    """Tell whether the topics of a recording have other names than ours: it is saved without a look at its frames.

    Raises:
        InputError: the names are ours, and not one frame can be read.
    """
    try:
        with contextlib.closing(open_recording(path).frames()) as frames:
            next(frames, None)
    except InputError as error:
        if error.code != "no_sensor":
            raise
        return True
    return False
