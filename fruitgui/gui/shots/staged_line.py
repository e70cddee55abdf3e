"""The live screen of a line that only seems to run: there at once, the same every time, and without a process."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial

import numpy as np
from PySide6.QtWidgets import QWidget

from fruitgui.gui.running import Running
from fruitgui.gui.session import Session
from fruitgui.gui.shots.setting_up import setting_up, simulated_rig
from fruitgui.gui.shots.stage import Stage
from fruitgui.gui.steps.belt.shots import made_station
from fruitgui.gui.steps.live.page import LivePage
from fruitgui.gui.steps.live.tally import Tally
from fruitgui.measurement.fruit import Quantity
from fruitgui.records.lot import Lot
from fruitgui.station.live.state import LiveState, Opinion, Phase, Spread, TrackNow
from fruitgui.station.workflow import Step

LAYOUT = "opposed"
SENSORS = ("kinect_1", "kinect_2")


class StagedRunning(Running):
    """Passes for a line that runs: it has the state that it was given, and counts nothing."""

    made = LiveState(Phase.STOPPED)

    @property
    def running(self) -> bool:
        """It seems to."""
        return True

    @property
    def state(self) -> LiveState | None:
        """What it was given."""
        return self.made

    @property
    def unnamed(self) -> int:
        """Some, so that they are offered to be named."""
        return 3


@contextmanager
def staged_line(stage: Stage, kinds: tuple[str, ...], tally: Tally) -> Iterator[QWidget]:
    """Open the live screen with fruit of these kinds on the belt, and a lot with this tally."""
    staged: list[StagedRunning] = []

    def put_in(session: Session) -> None:
        staged.append(StagedRunning(session.store, session.connected, session.tasks, session.messages, session))
        session.running = staged[0]

    with setting_up(stage, Step.LIVE, simulated_rig(LAYOUT), put_in) as on:
        running, page = staged[0], on.page
        assert isinstance(page, LivePage)  # noqa: S101 - it was opened at this step
        on.connect()
        on.session.save_station(made_station(LAYOUT, moving=True))
        stage.wait_until(lambda: not on.session.saving)
        now_s = time.time()
        running.lot = Lot(1, "1184", "Fundo El Peñón", "", "", SENSORS[0], None, None, {}, (), now_s, None, (), ())
        running.kinds, running.tally, running.made = kinds, tally, _state(kinds)
        running.changed.emit()
        stage.wait_until(partial(_shown, page))
        yield on.window


def _shown(page: LivePage) -> bool:
    return page.body.isVisible() and len(page.body.pictures.pictures) == len(SENSORS)


def _state(kinds: tuple[str, ...]) -> LiveState:
    """Return fruit of all kinds behind one another, under two sensors whose views of the belt overlap."""
    corners = np.array([[-0.6, -0.2], [0.5, -0.2], [0.55, 0.2], [-0.55, 0.2]])
    footprints = {sensor: corners + np.array([0.1 * number, 0.0]) for number, sensor in enumerate(SENSORS)}
    tracks = tuple(_track(number, kind) for number, kind in enumerate(kinds))
    return LiveState(
        Phase.RUNNING, 1, 1.0, tracks=tracks, footprints_m=footprints, belt_velocity_m_s=np.array([0.12, 0.0, 0.0])
    )


def _track(number: int, kind: str) -> TrackNow:
    x, y = -0.4 + 0.1 * number, -0.12 + 0.06 * (number % 5)
    place, spread = np.array([x, y]), Spread(x, y, 4e-3, 3e-3, 0.0)
    outline = np.array([[-0.03, -0.03], [0.03, -0.03], [0.03, 0.03], [-0.03, 0.03]]) + place
    trail = np.array([[-0.55, y], [x, y]])
    opinion = Opinion(kind, 0.97, Quantity(1.5e-4, 2e-6), 9)
    position_m, covariance_m2 = np.array([x, y, 0.0]), np.eye(3) * 1e-6
    return TrackNow(number + 1, position_m, covariance_m2, 9, 9, place, spread, trail, outline, opinion)
