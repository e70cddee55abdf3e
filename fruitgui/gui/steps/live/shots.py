"""The live screen in its states, on a simulated line that was calibrated and trained."""

from __future__ import annotations

import shutil
import tempfile
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
from PySide6.QtWidgets import QWidget

from fruitgui.classification.evidence import UNKNOWN
from fruitgui.evaluation.demo_line import set_up_line
from fruitgui.gui.health import HealthWatch
from fruitgui.gui.session import Session
from fruitgui.gui.shots.made_lots import made_fruit
from fruitgui.gui.shots.stage import Scene, Stage
from fruitgui.gui.shots.staged_line import staged_line
from fruitgui.gui.steps.live.page import LivePage
from fruitgui.gui.steps.live.tally import Tally
from fruitgui.gui.steps.page import StepPage
from fruitgui.gui.window import MainWindow
from fruitgui.records.lot import LotPlan
from fruitgui.sensors.feed import Running
from fruitgui.station.workflow import Step
from fruitgui.station.workspace import open_workspace

SEED = 1
ENOUGH_FRUIT = 40
LONG_MS = 300_000
WELL_S = 0.3
MANY = ("lemon", "red apple", "green apple", "avocado, Chilean", "quince", "persimmon", "pear, Packham's Triumph")
MANY_FRUIT = 3000
LOT = LotPlan("1184", "Fundo El Peñón")


@contextmanager
def line_window(stage: Stage, folder: Path) -> Iterator[tuple[Session, MainWindow, LivePage]]:
    """Open a window at the live screen of a workspace; on leaving, everything that runs is stopped."""
    session = Session(open_workspace(folder))
    page = LivePage(session, stage.theme)
    pages: Mapping[Step, StepPage] = {step: page if step is Step.LIVE else StepPage() for step in Step}
    window = MainWindow(stage.theme, session.messages, session.tasks, pages)
    health = HealthWatch(session, window.top_bar, window)
    session.states_changed.connect(lambda: window.show_states(session.states()))
    window.show_states(session.states())
    window.go_to(Step.LIVE)
    window.show()
    health.start()
    try:
        yield session, window, page
    finally:
        session.close()
        window.close()
        stage.settle()
        window.deleteLater()
        session.deleteLater()
        stage.settle()


@contextmanager
def _nothing(stage: Stage) -> Iterator[QWidget]:
    with tempfile.TemporaryDirectory(dir=stage.folder) as name, line_window(stage, Path(name) / "line_2") as opened:
        yield opened[1]


@contextmanager
def _line(stage: Stage, state: str) -> Iterator[QWidget]:
    with tempfile.TemporaryDirectory(dir=stage.folder) as name:
        folder = Path(name) / "line_2"
        shutil.copytree(_set_up(stage), folder)
        with line_window(stage, folder) as (session, window, page):
            session.start_sensors()
            stage.wait_until(partial(_sensors_run, session), LONG_MS)
            if state != "ready":
                session.start_lot(LOT)
                stage.wait_until(lambda: session.running.tally.count_all >= ENOUGH_FRUIT, LONG_MS)
            if state == "paused":
                page.pause.trigger()
                stage.wait_until(lambda: session.running.paused)
            if state == "silent":
                session.connected.health_changed.connect(partial(_silence, session))
                stage.wait_until(lambda: bool(page.body.pictures.pictures["kinect_2"].accessibleDescription()))
            if state == "kinds":
                session.running.kinds, session.running.tally = MANY, _many_kinds()
                stage.wait_until(lambda: "Quince" in page.body.counts.accessibleDescription())
            if state == "large":
                page.body.pictures.toggle("kinect_1")
            if state in ("running", "large"):
                stage.wait_until(partial(_all_is_well, session, page), LONG_MS)
            yield window


def _silence(session: Session) -> None:
    """Let the window believe that a sensor gives nothing; the dictionary is the one that it looks at."""
    now = session.connected.health["kinect_2"]
    session.connected.health["kinect_2"] = replace(now, state=Running.SILENT, age_s=37.0)


@contextmanager
def _staged(stage: Stage, kinds: tuple[str, ...]) -> Iterator[QWidget]:
    with staged_line(stage, kinds, _many_kinds(kinds)) as window:
        yield window


def _many_kinds(kinds: tuple[str, ...] = MANY) -> Tally:
    """Return a busy lot of these kinds and some fruit that are unknown."""
    rng = np.random.default_rng(SEED)
    tally = Tally()
    for number in range(MANY_FRUIT):
        kind = str(rng.choice([*kinds, UNKNOWN]))
        tally.count(replace(made_fruit(rng, number + 1, "lemon"), kind=kind), time.monotonic())
    return tally


def _sensors_run(session: Session) -> bool:
    health = session.connected.health
    return bool(health) and all(one.state is Running.RUNNING for one in health.values())


def _all_is_well(session: Session, page: LivePage) -> bool:
    """Whether a busy computer keeps up again, and no picture is of a while ago."""
    state, pictures = session.running.state, page.body.pictures.pictures.values()
    stale = any(one.accessibleDescription() for one in pictures)
    return state is not None and state.latency_s < WELL_S and _sensors_run(session) and not stale


def _set_up(stage: Stage) -> Path:
    """Return the folder of a line that is set up; made once for all scenes."""
    folder = stage.folder / "set_up_line"
    if not folder.exists():
        set_up_line(open_workspace(folder), SEED)
    return folder


SCENES: tuple[Scene, ...] = (
    Scene("live-nothing", _nothing),
    Scene("live-ready", partial(_line, state="ready")),
    Scene("live-running", partial(_line, state="running")),
    Scene("live-paused", partial(_line, state="paused")),
    Scene("live-silent", partial(_line, state="silent")),
    Scene("live-kinds", partial(_line, state="kinds")),
    Scene("live-staged", partial(_staged, kinds=MANY[:5])),
    Scene("live-staged-many", partial(_staged, kinds=(*MANY, "orange", "lime", "mandarin"))),
    Scene("live-large", partial(_line, state="large")),
)
