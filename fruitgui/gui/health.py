"""Whether all is well: the words at the top of the window, and warnings said once, at once."""

from __future__ import annotations

import logging
import shutil
from collections.abc import Callable
from functools import partial
from pathlib import Path

from PySide6.QtCore import QCoreApplication, QObject, QTimer

from fruitgui.gui.blind_words import blind_remedy, blind_text, sparse_remedy, sparse_text
from fruitgui.gui.messages import Level, Message
from fruitgui.gui.pills import disk_pill, line_pill, recording_pill, sensors_pill
from fruitgui.gui.queries import Queries
from fruitgui.gui.session import Session
from fruitgui.gui.told import Told
from fruitgui.gui.top_bar import TopBar
from fruitgui.station.live.blind import Blind
from fruitgui.station.live.state import LiveWarning

log = logging.getLogger(__name__)

LOOK_MS = 1000
STAYING = ("calibration_stale", "not_kept", "fruit_not_counted", "mostly_unknown", "line_begun_again", "line_lost")
"""Warnings that stay until a person has put them away: a lot may be wrong by them."""

AWAY = ("part_blind", "sensor_away")
SPARSE = ("part_sparse", "sensor_sparse")
AGAIN = (*AWAY, *SPARSE, "clock_jumped", "mostly_unknown", "line_begun_again")
"""Warnings that are said each time: a sensor that goes away once more, a clock that leaps once more, a belt that is wet
once more."""

BYTES_PER_GB = 1e9


class HealthWatch(QObject):
    """Keeps the pills of the top bar true, and says what the line warns of."""

    def __init__(self, session: Session, bar: TopBar, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._bar = bar
        self._said: set[tuple[str, tuple[str, ...], int]] = set()
        self._free_gb: float | None = None
        self._queries = Queries(self, linger_s=2.5 * LOOK_MS / 1e3)
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
        """Let what nobody sees of the belt, or not often enough, stand for as long as it is so."""
        running, messages = self._session.running, self._session.messages
        state = running.state if running.running else None
        blind, sparse = (None, None) if state is None else (state.blind, state.sparse)
        messages.stand("blind", None if blind is None else blind_message(blind))
        messages.stand("sparse", None if sparse is None else sparse_message(sparse))

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
                unseen = running.state.sparse if warning.code in SPARSE else running.state.blind
                self._session.messages.say(warning_message(warning, unseen))


def line_name(folder: Path) -> str:
    """Return what a line is called: its folder's name."""
    return folder.name[:1].upper() + folder.name[1:].replace("_", " ")


def warning_message(warning: LiveWarning, blind: Blind | None = None) -> Message:
    """Return a warning of the line as a message: what happened, what it means, what to do.

    Args:
        warning: of the line.
        blind: what nobody sees now, or not often enough, where it warns of that.
    """
    if blind is not None and blind.sensors == warning.sensors and warning.code in (*AWAY, *SPARSE):
        return (blind_message if warning.code in AWAY else sparse_message)(blind)
    words = {
        "calibration_stale": _bumped, "not_kept": _not_kept, "clock_jumped": _clock_jumped,
        "clock_put_right": _clock_put_right, "sensor_not_matched": _not_matched, "frame_skipped": _skipped,
        "fruit_not_measured": _not_measured, "fruit_not_counted": _not_counted,
        "part_blind": _away, "sensor_away": _away, "part_sparse": _sparse, "sensor_sparse": _sparse,
        "may_be_blinded": _may_be_blinded, "not_drawn": _not_drawn, "not_watched": _not_watched,
        "mostly_unknown": _mostly_unknown, "line_begun_again": _begun_again, "line_lost": _lost,
    }.get(warning.code)  # fmt: skip
    if words is None:
        return Message(Level.WARN, lambda: Told(warning.text))
    stays = warning.code in STAYING
    return Message(Level.BAD if stays else Level.WARN, partial(_told, words, ", ".join(warning.sensors)), stays=stays)


def blind_message(blind: Blind) -> Message:
    """Return what is said while nobody sees some of the belt."""
    level = Level.BAD if blind.loses_fruit else Level.WARN
    return Message(level, lambda: Told(f"{blind_text(blind)}.", blind_remedy(blind)))


def _told(words: Callable[[], tuple[str, str]], sensors: str) -> Told:
    what, remedy = words()
    return Told(what.format(sensors=sensors), remedy)


def sparse_message(sparse: Blind) -> Message:
    """Return what is said while sensors give too few pictures."""
    level = Level.BAD if sparse.loses_fruit else Level.WARN
    return Message(level, lambda: Told(f"{sparse_text(sparse)}.", sparse_remedy(sparse)))


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


def _sparse() -> tuple[str, str]:
    return (
        QCoreApplication.translate("Health", "Too few pictures came from {sensors} for a while."),
        QCoreApplication.translate(
            "Health", "Fruit that only it sees may be missing. Step 1 says why pictures are lost."
        ),
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


def _begun_again() -> tuple[str, str]:
    return (
        QCoreApplication.translate("Health", "The line broke off and goes on; fruit that were in view may be missing."),
        QCoreApplication.translate("Health", "Nothing is to be done now. If this comes back, call for help."),
    )


def _lost() -> tuple[str, str]:
    return (
        QCoreApplication.translate("Health", "The line broke off again and again: nothing is counted now."),
        QCoreApplication.translate("Health", "End the lot and start a new one. If this comes back, call for help."),
    )


def _mostly_unknown() -> tuple[str, str]:
    return (
        QCoreApplication.translate(
            "Health",
            "Most fruit are unknown to the model: the light or the belt's colour may have changed since teaching.",
        ),
        QCoreApplication.translate(
            "Health", "Clean the belt where it is wet or dirty; or name some of these fruit and train again."
        ),
    )
