"""A belt as it was set, kept; it can be taken back."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QCoreApplication

from fruitgui.gui.messages import Level, Message
from fruitgui.gui.session import Session
from fruitgui.gui.steps.belt.draft import Draft, saved_in
from fruitgui.gui.told import Told
from fruitgui.station.fingerprint import calibration_fingerprint
from fruitgui.station.station import Station


def save_belt(session: Session, draft: Draft, station: Station) -> None:
    """Keep a belt in the station that it was set on, note for which sensors, and say so once it is on the disk."""
    marks = session.marks
    session.save_station(saved_in(draft, station))
    session.save_marks(marks.model_copy(update={"belt_calibration": calibration_fingerprint(station)}))

    def take_back() -> None:
        session.save_station(station)
        session.save_marks(marks)

    session.when_saved(partial(session.messages.say, Message(Level.GOOD, _saved, take_back)))


def _saved() -> Told:
    translate = QCoreApplication.translate
    return Told(translate("BeltPage", "The belt is saved."), action=translate("BeltPage", "Undo"))
