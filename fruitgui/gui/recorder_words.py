"""What the window says of a recording."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication

from fruitgui.gui.numbers import THIN, count_text, number_text
from fruitgui.gui.times import duration_text
from fruitgui.station.record_state import Ending, Recorded, RecordState

translate = QCoreApplication.translate


def size_text(size: float) -> str:
    """Return so many bytes in MB or GB."""
    if size < 1e9:
        return f"{number_text(size / 1e6, 0)}{THIN}MB"
    return f"{number_text(size / 1e9, 1)}{THIN}GB"


def clock_time(seconds: float) -> str:
    """Return a running time as minutes and seconds, or hours too."""
    whole = int(seconds)
    hours, minutes = divmod(whole // 60, 60)
    return f"{hours}:{minutes:02d}:{whole % 60:02d}" if hours else f"{minutes}:{whole % 60:02d}"


def recorded_message(done: Recorded) -> tuple[str, str, bool]:
    """Return what to say of a recording that was made, what to do, and whether all is well with it."""
    what = translate("Recorder", "{name} is recorded: {lasted}, {size}.").format(
        name=done.parts[0].stem, lasted=duration_text(done.seconds), size=size_text(done.bytes_written)
    )
    problems = []
    if done.ended is Ending.DISK_FULL:
        problems.append(translate("Recorder", "It was ended because the disk is nearly full."))
    if done.ended is Ending.SENSORS_ENDED:
        problems.append(translate("Recorder", "It was ended because no sensor gives pictures any more."))
    lost = sum(done.lost.values())
    if lost:
        problems.append(lost_text(lost))
    missed = sum(done.missed.values())
    if missed:
        text = translate("Recorder", "{count} pictures did not come whole from the sensors: check them.")
        problems.append(text.format(count=count_text(missed)))
    silent = sorted({silence.sensor for silence in done.silences})
    if silent:
        problems.append(silent_text(silent))
    return what, " ".join(problems), not problems


def lost_text(count: int) -> str:
    """Return that frames were lost."""
    return translate("Recorder", "{count} pictures were lost: this computer, or its disk, is too slow.").format(
        count=count_text(count)
    )


def silent_text(sensors: list[str]) -> str:
    """Return that sensors gave nothing for a while."""
    return translate("Recorder", "Without pictures for a while: {sensors}.").format(sensors=", ".join(sensors))


def progress_text(state: RecordState) -> str:
    """Return how much there is so far."""
    frames = count_text(sum(state.frames.values()))
    return translate("Recorder", "{frames} pictures, {size}").format(frames=frames, size=size_text(state.bytes_written))


def room_text(state: RecordState) -> str:
    """Return how much room is left, and for how long."""
    size = size_text(state.room_bytes)
    if state.room_s is None:
        return translate("Recorder", "{size} free").format(size=size)
    return translate("Recorder", "{size} free, enough for {time}").format(size=size, time=duration_text(state.room_s))
