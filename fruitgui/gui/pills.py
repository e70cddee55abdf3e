"""How sensors, line, recording and disk are, in a word each: the pills at the top of the window."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QCoreApplication

from fruitgui.gui.numbers import THIN, number_text
from fruitgui.gui.recorder_words import clock_time
from fruitgui.gui.top_bar import Pill
from fruitgui.sensors.feed import Running, SensorHealth
from fruitgui.station.live.state import LiveState
from fruitgui.station.record_state import RecordPlan, RecordState

SLOW_S = 1.0
"""Behind by more than this, a person at the belt sees a fruit counted when it is out of reach."""

BEHIND_FRAMES = 30

ROUND_GB = 20.0
"""Room from which on a tenth of a GB says nothing; near the limit it tells on which side one is."""


def sensors_pill(health: Mapping[str, SensorHealth]) -> Pill:
    """Return how many of the sensors run."""
    well = [name for name, one in health.items() if one.state in (Running.RUNNING, Running.ENDED) and not one.useless]
    missing = [name for name in health if name not in well]
    text = QCoreApplication.translate("Health", "{well}/{all} sensors").format(well=len(well), all=len(health))
    if not missing:
        return Pill(
            "sensors", "camera", text, "good", QCoreApplication.translate("Health", "All sensors give pictures.")
        )
    if all(health[name].state is Running.STARTING for name in missing):
        return Pill("sensors", "camera", text, "", QCoreApplication.translate("Health", "The sensors are starting."))
    tip = QCoreApplication.translate("Health", "No pictures from {sensors}; its part of the belt is not seen.")
    return Pill("sensors", "camera", text, "bad", tip.format(sensors=", ".join(missing)))


def line_pill(state: LiveState) -> Pill:
    """Return how far behind the line is, and what it had no time for."""
    dropped = sum(state.dropped.values())
    slow = state.latency_s > SLOW_S or state.backlog > BEHIND_FRAMES
    text = f"{number_text(state.latency_s * 1e3, 0)}{THIN}ms"
    tip = QCoreApplication.translate(
        "Health", "From a picture to what is drawn: {latency}. Waiting: {backlog} pictures. Left out: {dropped}."
    ).format(latency=text, backlog=state.backlog, dropped=dropped)
    return Pill("line", "clock", text, "warn" if slow or dropped else "good", tip)


def recording_pill(plan: RecordPlan, state: RecordState | None) -> Pill:
    """Return how far a recording is."""
    seconds = 0.0 if state is None else state.seconds
    troubled = state is not None and (bool(state.silent) or any(state.lost.values()))
    tip = QCoreApplication.translate("Health", "Recording {name}: see Connect.").format(name=plan.out.stem)
    return Pill("recording", "record", clock_time(seconds), "warn" if troubled else "good", tip)


def disk_pill(free_gb: float, least_gb: float) -> Pill:
    """Return how much room the disk has."""
    health = "" if free_gb > 2.0 * least_gb else ("warn" if free_gb > least_gb else "bad")
    tip = QCoreApplication.translate(
        "Health", "Free on the disk: {free} GB. Recording and keeping pictures stop below {least} GB."
    ).format(free=number_text(free_gb, 2), least=number_text(least_gb, 2))
    return Pill("disk", "disk", f"{number_text(free_gb, 0 if free_gb >= ROUND_GB else 1)}{THIN}GB", health, tip)
