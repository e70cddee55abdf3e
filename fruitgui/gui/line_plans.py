"""What a line is started with, by what a session has: its station, its model, its sensors and their turns."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from fruitgui.errors import InputError
from fruitgui.gui.beginning import LinePlan
from fruitgui.gui.saving import Saving
from fruitgui.gui.source_runner import SourceRunner
from fruitgui.records.lot import LotPlan
from fruitgui.sensors.feed import Feed
from fruitgui.station.connection import Connection
from fruitgui.station.live import FLAT_OUT, LIVE, PLAYED
from fruitgui.station.model import Model
from fruitgui.station.projectors import Projectors
from fruitgui.station.sources import is_finite, is_plugged
from fruitgui.station.station import Station
from fruitgui.station.station_file import station_value
from fruitgui.station.turn_plan import overlapping, rig_of, schedule_of
from fruitgui.station.workspace import Workspace


def on_station(plan: LotPlan, station: Station) -> LotPlan:
    """Return a lot's plan with the station that it runs on."""
    text = json.dumps(station_value(station))
    return replace(plan, reference_sensor=station.reference, model=station.model, station_text=text)


def line_plan(
    station: Station, model: Callable[[], Model | None], connection: Connection | None, source: SourceRunner
) -> LinePlan:
    """Return how the line is to run: a recording from its beginning and as fast as it goes, devices as they give."""
    if connection is not None and is_finite(connection.source):
        return LinePlan(station, model, lambda: source.fresh_feed(connection), FLAT_OUT)
    plugged = connection is None or is_plugged(connection.source)
    return LinePlan(station, model, intake=LIVE if plugged else PLAYED)


def model_reader(workspace: Workspace, saving: Saving, station: Station) -> Callable[[], Model | None]:
    """Return what reads the model that a station names; it takes a moment, so a task calls it."""

    def model() -> Model | None:
        saving.wait()  # what a person typed of kinds just now belongs to the model
        kept = workspace.model(station)
        if kept.damage is not None:
            raise kept.damage.error if kept.damage.set_aside or kept.damage.file.exists() else _gone(kept.damage.file)
        return kept.value

    return model


def _gone(path: Path) -> InputError:
    return InputError("no_such_model", f"{path} is not there.", "Choose another model, or train again.")


def arrange_turns(feed: Feed, station: Station | None, projectors: Projectors) -> None:
    """Let the projectors of a feed take turns by what is known of the rig now."""
    rig = rig_of(station, {name: info.intrinsics for name, info in feed.infos.items()})
    known, disturbing = projectors.known(), projectors.disturbing(feed.infos.values())
    schedule = schedule_of(feed.infos, None if rig is None else overlapping(rig), known, disturbing)
    if schedule != feed.schedule:
        feed.take_turns(schedule)
