"""Changes of the sensors that are connected: named, put in order, chosen as the reference, left out and taken back."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject

from fruitgui.gui.session import Session
from fruitgui.gui.steps.connect.details import SensorDetails
from fruitgui.gui.told import Told
from fruitgui.station.connection import Connection
from fruitgui.station.connection_changes import moved, referred_to, renamed, without


class SensorChanges(QObject):
    """Does what is asked of the chosen sensor.

    Args:
        session: whose connection is changed.
        details: ask for it.
        chosen: the sensor's name. choose: told of its new one.
    """

    def __init__(
        self, session: Session, details: SensorDetails, chosen: Callable[[], str], choose: Callable[[str], None]
    ) -> None:
        super().__init__(details)
        self._session = session
        self._chosen = chosen
        self._choose = choose
        details.renamed.connect(self.rename)
        details.moved.connect(self._move)
        details.reference.connect(self._refer)
        details.leave.connect(self._leave_out)

    def rename(self, name: str) -> None:
        """Give the sensor another name."""
        connection = self._session.connection
        if connection is not None:
            changed = renamed(connection, self._chosen(), name)
            self._choose(name)
            self._session.save_connection(changed)
            self._session.start_sensors()

    def _move(self, by: int) -> None:
        if self._session.connection is not None:
            self._session.save_connection(moved(self._session.connection, self._chosen(), by))

    def _refer(self) -> None:
        if self._session.connection is not None:
            self._session.save_connection(referred_to(self._session.connection, self._chosen()))

    def _leave_out(self) -> None:
        before, name = self._session.connection, self._chosen()
        if before is not None and len(before.sensors) > 1:
            self._session.save_connection(without(before, name))
            self._session.start_sensors()
            self._session.messages.info(lambda: self._left_out(name), lambda: self._restore(before))

    def _left_out(self, name: str) -> Told:
        return Told(self.tr("{sensor} is left out.").format(sensor=name), action=self.tr("Undo"))

    def _restore(self, connection: Connection) -> None:
        self._session.save_connection(connection)
        self._session.start_sensors()
