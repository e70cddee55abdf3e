"""Says when the belt runs faster than the sensors can follow as they take turns now."""

from __future__ import annotations

from functools import partial

import numpy as np
from PySide6.QtCore import QObject

from fruitgui.gui.messages import Level, Message
from fruitgui.gui.numbers import THIN, number_text
from fruitgui.gui.session import Session
from fruitgui.gui.steps.connect.presenter import plan_of
from fruitgui.gui.told import Told

ABOVE = 1.03
"""Times the highest speed: the belt's own is known to a hundredth or two."""


class SpeedWatch(QObject):
    """Looks twice a second while a lot runs, and says it once for each lot."""

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._said: int | None = None
        session.connected.health_changed.connect(self.look)

    def look(self) -> None:
        """Look now."""
        session, lot = self._session, self._session.running.lot
        state = session.running.state
        if lot is None or lot.key == self._said or not session.running.running or state is None:
            return
        if state.belt_velocity_m_s is None:
            return
        plan = plan_of(session.connected.feed, session.station, session.projectors)
        speed_m_s = float(np.linalg.norm(state.belt_velocity_m_s))
        if plan is not None and speed_m_s > ABOVE * plan.highest_speed_m_s:
            self._said = lot.key
            told = partial(self._told, speed_m_s, plan.highest_speed_m_s)
            session.messages.say(Message(Level.BAD, told, stays=True))

    def _told(self, speed_m_s: float, highest_m_s: float) -> Told:
        what = self.tr("The belt runs at {speed}; these sensors follow fruit up to {highest}.").format(
            speed=f"{number_text(speed_m_s, 2)}{THIN}m/s", highest=f"{number_text(highest_m_s, 2)}{THIN}m/s"
        )
        remedy = self.tr("Slow it down: fruit may be missed, or counted twice. Step 1 says what limits the speed.")
        return Told(what, remedy)
