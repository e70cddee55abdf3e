"""What was measured of a device is kept in the line's folder, or taken away; either can be undone."""

from __future__ import annotations

from datetime import datetime
from functools import partial

from PySide6.QtCore import QCoreApplication

from fruitgui.calibration.depth.measured import DepthFit
from fruitgui.gui.messages import Level, Message
from fruitgui.gui.session import Session
from fruitgui.station.depths import DeviceDepth, device_depth

translate = QCoreApplication.translate


class Keeping:
    """Keeps corrections of a session's sensors by their serials, and says so."""

    def __init__(self, session: Session) -> None:
        self._session = session

    def corrected(self, sensor: str) -> bool:
        """Return whether a sensor's depth is corrected."""
        known = self._session.depths.of(self._serial(sensor), sensor)
        return known is not None and known.correction is not None

    def keep(self, sensor: str, fit: DepthFit) -> None:
        """Correct a sensor's depth from now on."""
        text = translate("DepthWizard", "The depth of {sensor} is corrected from now on.")
        self._save(sensor, device_depth(fit, datetime.now().astimezone()), text)

    def remove(self, sensor: str) -> None:
        """Use a sensor's depth as the device gives it."""
        text = translate("DepthWizard", "The depth of {sensor} is used as the device gives it.")
        self._save(sensor, DeviceDepth(), text)

    def _save(self, sensor: str, device: DeviceDepth, text: str) -> None:
        session, before = self._session, self._session.depths
        session.save_depths(before.with_device(self._serial(sensor), sensor, device))
        remedy = translate("DepthWizard", "Calibrate again.") if session.station is not None else ""
        undo = translate("DepthWizard", "Undo")
        said = Message(
            Level.GOOD, text.format(sensor=sensor), remedy, action=undo, act=partial(session.save_depths, before)
        )
        session.when_saved(partial(session.messages.say, said))

    def _serial(self, sensor: str) -> str:
        connection = self._session.connection
        return "" if connection is None else connection.serials().get(sensor, "")
