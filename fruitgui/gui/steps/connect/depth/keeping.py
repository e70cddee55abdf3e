"""What is kept of a sensor's depth: its correction, or none; either can be taken back."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QCoreApplication

from fruitgui.gui.messages import Level, Message
from fruitgui.gui.session import Session
from fruitgui.gui.told import Told
from fruitgui.station.depths import DeviceDepth

translate = QCoreApplication.translate


def corrected(session: Session, sensor: str) -> bool:
    """Tell whether a sensor's depth is corrected now."""
    known = session.depths.of(_serial(session, sensor), sensor)
    return known is not None and known.correction is not None


def keep_depth(session: Session, sensor: str, device: DeviceDepth) -> None:
    """Use a sensor's depth so from now on, and say so once it is on the disk."""
    before, calibrated = session.depths, session.station is not None
    session.save_depths(before.with_device(_serial(session, sensor), sensor, device))

    def told() -> Told:
        if device.correction is None:
            what = translate("DepthWizard", "The depth of {sensor} is used as the device gives it.")
        else:
            what = translate("DepthWizard", "The depth of {sensor} is corrected from now on.")
        remedy = translate("DepthWizard", "Calibrate again.") if calibrated else ""
        return Told(what.format(sensor=sensor), remedy, translate("DepthWizard", "Undo"))

    said = Message(Level.GOOD, told, partial(session.save_depths, before))
    session.when_saved(partial(session.messages.say, said))


def _serial(session: Session, sensor: str) -> str:
    connection = session.connection
    return "" if connection is None else connection.serials().get(sensor, "")
