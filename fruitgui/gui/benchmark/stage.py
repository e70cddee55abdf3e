"""What the window is timed on: a simulated line that is set up, and a recording of it that is played for ever."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_context
from pathlib import Path

from fruitgui.evaluation.demo_line import set_up_line
from fruitgui.gui.beginning import LinePlan
from fruitgui.gui.session import Session
from fruitgui.records.lot import LotPlan
from fruitgui.records.store import open_store
from fruitgui.sensors.feed import Feed
from fruitgui.sensors.player import FlatOut, recorded_sensors
from fruitgui.simulation.scenes import line_scene
from fruitgui.station.connection import connection_to
from fruitgui.station.live import FLAT_OUT
from fruitgui.station.record_simulated import record_simulation
from fruitgui.station.sources import RecordedSource
from fruitgui.station.workspace import open_workspace

SEED = 1
FRUIT, SPEED_M_S, PER_METRE = 40, 0.2, 14.0
FRUIT_PER_HOUR = 3600.0 * SPEED_M_S * PER_METRE
RECORDING = "run.mcap"


@contextmanager
def stage_in(folder: Path | None) -> Iterator[Path]:
    """Give the folder of a line that is set up; made where it is not there, and forgotten unless it was named."""
    if folder is not None:
        _made(folder)
        yield folder
        return
    with tempfile.TemporaryDirectory(prefix="fruitgui-benchmark-") as name:
        made = Path(name) / "line"
        _made(made)
        yield made


def _made(folder: Path) -> None:
    if (folder / RECORDING).exists():
        _end_open_lot(folder)
        return
    # What calibrating and training load and leave, some 200 MB, is none of the window's, whose memory is measured here.
    with ProcessPoolExecutor(1, get_context("spawn")) as apart:
        apart.submit(make_line, folder).result()


def make_line(folder: Path) -> None:
    """Set a simulated line up in a folder, record what runs on it, and connect it to that recording."""
    workspace = open_workspace(folder)
    set_up_line(workspace, SEED)
    path = folder / RECORDING
    record_simulation(line_scene(SEED + 4, FRUIT, SPEED_M_S, rig_seed=SEED, per_metre=PER_METRE), path)
    source = RecordedSource(path, looped=True)
    workspace.connection.save(connection_to(source.value(), source.connect().sensors))


def _end_open_lot(folder: Path) -> None:
    """End the lot that the last run left open when its window was closed in the middle of it."""
    with open_store(folder) as store:
        lot = store.lots.open_lot()
        if lot is not None:
            store.lots.end(lot.key)


def start_flat_out(session: Session, folder: Path) -> None:
    """Start a lot on the recording, over and over, as fast as the line can, without leaving a picture out."""
    station = session.station
    assert station is not None  # noqa: S101 - it was set up

    def again() -> Feed:
        return Feed(recorded_sensors(folder / RECORDING, FlatOut(), looped=True))

    plan = LinePlan(station, lambda: session.workspace.model(station).value, again, FLAT_OUT)
    session.running.start_lot(plan, LotPlan("benchmark", reference_sensor=station.reference))
