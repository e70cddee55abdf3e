"""A window on a fresh folder with a frozen rig: what the scenes of the set-up screens begin with."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from fruitgui.gui.pages import page_maker
from fruitgui.gui.session import Session
from fruitgui.gui.shots.frozen import FrozenSource, frozen_source, frozen_sources
from fruitgui.gui.shots.stage import Stage
from fruitgui.gui.steps.page import StepPage
from fruitgui.gui.window import MainWindow
from fruitgui.simulation.scenes import still_scene
from fruitgui.station.workflow import Step
from fruitgui.station.workspace import open_workspace

SEED = 3
ENOUGH_FRAMES = 4


@dataclass(frozen=True, slots=True, eq=False)
class SettingUp:
    """A window on one step, with what it works on."""

    stage: Stage
    session: Session
    window: MainWindow
    page: StepPage
    rig: FrozenSource

    def connect(self) -> None:
        """Connect the rig, and wait until every sensor has given pictures."""
        self.session.source.choose(self.rig)
        self.stage.wait_until(self.running)

    def running(self) -> bool:
        """Whether every sensor has given pictures."""
        health = self.session.connected.health
        return len(health) > 0 and all(one.frames >= ENOUGH_FRAMES for one in health.values())


@contextmanager
def setting_up(
    stage: Stage, step: Step, rig: FrozenSource, prepare: Callable[[Session], None] = lambda _session: None
) -> Iterator[SettingUp]:
    """Open a window at a step of a session, `prepare`d before; on leaving, everything that runs is stopped."""
    with tempfile.TemporaryDirectory(dir=stage.folder) as folder:
        session = Session(open_workspace(Path(folder)), sources=frozen_sources(rig))
        prepare(session)
        pages: Mapping[Step, StepPage] = {
            one: page_maker(one)(session, stage.theme) if one is step else StepPage() for one in Step
        }
        window = MainWindow(stage.theme, session.messages, session.tasks, pages)
        session.states_changed.connect(lambda: window.show_states(session.states()))
        window.show_states(session.states())
        window.top_bar.show_place("Line 2", "")
        window.go_to(step)
        window.show()
        try:
            yield SettingUp(stage, session, window, pages[step], rig)
        finally:
            session.close()
            window.close()
            stage.settle()
            window.deleteLater()
            session.deleteLater()
            stage.settle()


@cache
def simulated_rig(layout: str, sensors: int = 0, captures: int = 1) -> FrozenSource:
    """Return a rig that passes for the simulated one, rendered once."""
    return frozen_source(still_scene(SEED, layout, 15, sensors=sensors, captures=captures), layout, "simulated")


@cache
def sparse_rig() -> FrozenSource:
    """Return a rig before which next to nothing lies."""
    return frozen_source(still_scene(6, "opposed", 1, captures=1, with_rails=False), "sparse", "simulated")
