"""Whether all is well: the words at the top of the window, and warnings said once, at once."""

from __future__ import annotations

import logging
import shutil
from collections.abc import Mapping
from functools import partial
from pathlib import Path

from PySide6.QtCore import QCoreApplication, QObject, QTimer

from fruitgui.gui.blind_words import blind_remedy, blind_text
from fruitgui.gui.messages import Level, Message
from fruitgui.gui.numbers import THIN, number_text
from fruitgui.gui.queries import Queries
from fruitgui.gui.recorder_words import clock_time
from fruitgui.gui.session import Session
from fruitgui.gui.top_bar import Pill, TopBar
from fruitgui.sensors.feed import Running, SensorHealth
from fruitgui.station.live.blind import Blind
from fruitgui.station.live.state import LiveState, LiveWarning
from fruitgui.station.record_state import RecordPlan, RecordState

log = logging.getLogger(__name__)

LOOK_MS = 1000
SLOW_S = 1.0
"""Behind by more than this, a person at the belt sees a fruit counted when it is out of reach."""

BEHIND_FRAMES = 30
STAYING = ("calibration_stale", "not_kept", "fruit_not_counted")
"""Warnings that stay until a person has put them away: a lot may be wrong by them."""

AWAY = ("part_blind", "sensor_away")
AGAIN = (*AWAY, "clock_jumped")
"""Warnings that are said each time: a sensor that goes away once more, a clock that leaps once more."""

BYTES_PER_GB = 1e9

ROUND_GB = 20.0
"""Room from which on a tenth of a GB says nothing; near the limit it tells on which side one is."""


class HealthWatch(QObject):
    """Keeps the pills of the top bar true, and says what the line warns of."""

    def __init__(self, session: Session, bar: TopBar, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._bar = bar
        self._said: set[tuple[str, tuple[str, ...], int]] = set()
        self._free_gb: float | None = None
        self._queries = Queries(self)
        self._timer = QTimer(self, interval=LOOK_MS)
        self._timer.timeout.connect(self._ask)
        session.running.ticked.connect(self._warn)
        bar.words_wanted.connect(self.look)
        session.running.changed.connect(self.look)
        session.recorder.changed.connect(self.look)
        session.connected.changed.connect(self.look)

    def start(self) -> None:
        """Begin to look, once a second."""
        self._timer.start()
        self._ask()

    def stop(self) -> None:
        """Look no more: the bar is about to go."""
        self._timer.stop()
        self._queries.finish()

    def _ask(self) -> None:
        """Look, and ask beside the window how much room the disk has: one in a network may take its time."""
        folder = self._session.workspace.folder
        self._queries.ask("disk", lambda: shutil.disk_usage(folder).free / BYTES_PER_GB, self._take_free)
        self.look()

    def _take_free(self, free_gb: float) -> None:
        first, self._free_gb = self._free_gb is None, free_gb
        if first:
            self.look()

    def look(self) -> None:
        """Show how all is now."""
        running = self._session.running
        pills = [sensors_pill(self._session.connected.health)] if self._session.connected.health else []
        if running.running and running.state is not None:
            pills.append(line_pill(running.state))
        recorder = self._session.recorder
        if recorder.plan is not None:
            pills.append(recording_pill(recorder.plan, recorder.state))
        if self._free_gb is not None:
            pills.append(disk_pill(self._free_gb, self._session.settings.least_free_mb / 1000.0))
        self._bar.show_pills(tuple(pills))
        lot = running.lot
        place = "" if lot is None else " · ".join(text for text in (lot.name, lot.grower) if text)
        self._stand()
        self._bar.show_place(line_name(self._session.workspace.folder), place)

    def _stand(self) -> None:
        """Let what nobody sees of the belt stand for as long as it is not seen."""
        running = self._session.running
        blind = running.state.blind if running.running and running.state is not None else None
        self._session.messages.stand("blind", None if blind is None else blind_message(blind))

    def _warn(self) -> None:
        """Say each warning of the line once; those of a bumped rig stay until they are put away."""
        running = self._session.running
        self._stand()
        if running.state is None or not running.running:
            self._said.clear()
            return
        for warning in running.state.warnings:
            key = (warning.code, warning.sensors, warning.count if warning.code in AGAIN else 1)
            if key not in self._said:
                self._said.add(key)
                log.warning("%s %s", warning.code, warning.text)
                self._session.messages.say(warning_message(warning, running.state.blind))


def line_name(folder: Path) -> str:
    """Return what a line is called: its folder's name."""
    return folder.name[:1].upper() + folder.name[1:].replace("_", " ")


def warning_message(warning: LiveWarning, blind: Blind | None = None) -> Message:
    """Return a warning of the line as a message: what happened, what it means, what to do.

    Args:
        warning: of the line.
        blind: what nobody sees now.
    """
    if warning.code in AWAY and blind is not None and blind.sensors == warning.sensors:
        return blind_message(blind)
    words = {
        "calibration_stale": _bumped, "not_kept": _not_kept, "clock_jumped": _clock_jumped,
        "clock_put_right": _clock_put_right, "sensor_not_matched": _not_matched, "frame_skipped": _skipped,
        "fruit_not_measured": _not_measured, "fruit_not_counted": _not_counted,
        "part_blind": _away, "sensor_away": _away, "may_be_blinded": _may_be_blinded,
        "not_drawn": _not_drawn, "not_watched": _not_watched,
    }.get(warning.code)  # fmt: skip
    if words is None:
        return Message(Level.WARN, warning.text)
    what, remedy = words()
    stays = warning.code in STAYING
    sensors = ", ".join(warning.sensors)
    level, again = Level.BAD if stays else Level.WARN, partial(warning_message, warning, blind)
    return Message(level, what.format(sensors=sensors), remedy, stays=stays, again=again)


def blind_message(blind: Blind) -> Message:
    """Return what is said while nobody sees some of the belt."""
    level = Level.BAD if blind.loses_fruit else Level.WARN
    return Message(level, f"{blind_text(blind)}.", blind_remedy(blind))


def _bumped() -> tuple[str, str]:
    return (
        QCoreApplication.translate("Health", "A sensor was moved since it was calibrated: {sensors}."),
        QCoreApplication.translate("Health", "End the lot and calibrate again; sizes and counts since may be wrong."),
    )


def _not_kept() -> tuple[str, str]:
    return (
        QCoreApplication.translate("Health", "Fruit cannot be kept on the disk now; they wait in memory."),
        QCoreApplication.translate("Health", "Make room on the disk. Counting goes on, and what waits is kept then."),
    )


def _clock_jumped() -> tuple[str, str]:
    return (
        QCoreApplication.translate(
            "Health", "The clock of {sensors} leapt: fruit of this moment may be missing or twice."
        ),
        QCoreApplication.translate(
            "Health", "It is followed on from there. If this comes back, unplug the sensor and plug it in again."
        ),
    )


def _clock_put_right() -> tuple[str, str]:
    return (
        QCoreApplication.translate("Health", "The clock of {sensors} was off and was put right, judged by the fruit."),
        QCoreApplication.translate("Health", "No fruit was counted before; nothing is to be done."),
    )


def _not_matched() -> tuple[str, str]:
    return (
        QCoreApplication.translate("Health", "Sensors and calibration differ; the line runs on what both have."),
        QCoreApplication.translate("Health", "Connect the sensors that were calibrated, or calibrate again."),
    )


def _skipped() -> tuple[str, str]:
    return (
        QCoreApplication.translate("Health", "A picture of {sensors} could not be used and was left out."),
        QCoreApplication.translate("Health", "If this comes back, look at the sensor's cable; the log says more."),
    )


def _not_measured() -> tuple[str, str]:
    return (
        QCoreApplication.translate("Health", "A fruit could not be measured; it is counted with a rough volume."),
        QCoreApplication.translate("Health", "Look at it in the lot, and correct it there if need be."),
    )


def _away() -> tuple[str, str]:
    return (
        QCoreApplication.translate("Health", "No pictures came from {sensors} for a while."),
        QCoreApplication.translate("Health", "Fruit that only it sees were not counted. Check cable and power."),
    )


def _may_be_blinded() -> tuple[str, str]:
    return (
        QCoreApplication.translate("Health", "A driver hangs, and a projector may be on out of its turn: {sensors}."),
        QCoreApplication.translate(
            "Health", "Depth may have holes and sizes may be wrong. Unplug the sensor that gives no pictures."
        ),
    )


def _not_drawn() -> tuple[str, str]:
    return (
        QCoreApplication.translate("Health", "What {sensors} sees could not be drawn; fruit are counted all the same."),
        QCoreApplication.translate("Health", "The log says what went wrong: open the help, then Show log."),
    )


def _not_watched() -> tuple[str, str]:
    return (
        QCoreApplication.translate("Health", "Whether every sensor gives pictures is not known; the line goes on."),
        QCoreApplication.translate("Health", "Look at the pictures; the log says what went wrong."),
    )


def _not_counted() -> tuple[str, str]:
    return (
        QCoreApplication.translate("Health", "A fruit was followed but could not be counted."),
        QCoreApplication.translate("Health", "The log says what went wrong: open the help, then Show log."),
    )


def sensors_pill(health: Mapping[str, SensorHealth]) -> Pill:
    """Return how many of the sensors run."""
    well = [name for name, one in health.items() if one.state in (Running.RUNNING, Running.ENDED)]
    missing = [name for name in health if name not in well]
    text = QCoreApplication.translate("Health", "{well}/{all} sensors").format(well=len(well), all=len(health))
    if not missing:
        return Pill("sensors", "camera", text, "good")
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
