"""The seven screens, put together."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from fruitgui.gui.session import Session
from fruitgui.gui.steps.belt.page import BeltPage
from fruitgui.gui.steps.calibrate.page import CalibratePage
from fruitgui.gui.steps.connect.page import ConnectPage
from fruitgui.gui.steps.live.page import LivePage
from fruitgui.gui.steps.lots.page import LotsPage
from fruitgui.gui.steps.page import StepPage
from fruitgui.gui.steps.teach.page import TeachPage
from fruitgui.gui.steps.train.page import TrainPage
from fruitgui.gui.theme.theme import Theme
from fruitgui.station.workflow import Step

PageMaker = Callable[[Session, Theme], StepPage]

MAKERS: Mapping[Step, PageMaker] = {
    Step.CONNECT: ConnectPage,
    Step.CALIBRATE: CalibratePage,
    Step.BELT: BeltPage,
    Step.TEACH: TeachPage,
    Step.TRAIN: TrainPage,
    Step.LIVE: LivePage,
    Step.LOTS: LotsPage,
}


def make_pages(session: Session, theme: Theme) -> dict[Step, StepPage]:
    """Return a page for every step."""
    return {step: MAKERS[step](session, theme) for step in Step}
