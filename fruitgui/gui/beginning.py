"""How a line begins to count into a lot: what it needs, and both started, or neither; on a thread of a task."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from PySide6.QtCore import QCoreApplication, QDateTime, QLocale

from fruitgui.errors import FruitguiError
from fruitgui.progress import Cancelled, stop_if
from fruitgui.records.lot import Lot
from fruitgui.records.set_aside import SetAside
from fruitgui.records.store import Store
from fruitgui.records.totals import KindTotal
from fruitgui.sensors.feed import Feed
from fruitgui.station.live import LIVE, Counting, Intake, LineApart
from fruitgui.station.model import Model
from fruitgui.station.noted import NotedSink
from fruitgui.station.station import Station
from fruitgui.station.waiting import BufferedSink


@dataclass(frozen=True, slots=True, eq=False)
class LinePlan:
    """What a line is started with.

    Attributes:
        station: that its sensors belong to.
        model: reads the model; it takes a moment, so a task calls it.
        again: makes the sensors anew, for recordings: they are played from their beginning, and wait for the line.
            None for sensors that run by themselves.
        intake: how their frames get into the line.
    """

    station: Station
    model: Callable[[], Model | None]
    again: Callable[[], Feed] | None = None
    intake: Intake = LIVE


@dataclass(frozen=True, slots=True, eq=False)
class Begun:
    """A lot that runs.

    Attributes:
        feed, line: that runs, and counts into the lot.
        lot: that is counted into.
        sink: tells what is durable.
        aside: keeps unknown fruit to be named; None without a model, to which every fruit is unknown.
        kinds: that the model knows.
        totals: what the lot holds already.
    """

    feed: Feed
    line: LineApart
    lot: Lot
    sink: NotedSink
    aside: SetAside | None
    kinds: tuple[str, ...]
    totals: tuple[KindTotal, ...]


def begun(
    feed: Feed, plan: LinePlan, store: Store, begin: Callable[[], Lot], source: str, cancelled: Cancelled
) -> Begun:
    """Start line and lot, both or neither.

    Args:
        feed: the sensors that run now; stopped where the plan makes them anew.
        plan: what the line is started with.
        store: keeps fruit.
        begin: begins the lot, or goes on with one.
        source: where unknown fruit of this run are said to come from.
        cancelled: asked once more before the lot begins; after that both are there.

    Raises:
        CancelledByUserError: `cancelled` said so.
        FruitguiError: the sensors, the model or the store cannot be used.
    """
    if plan.again is not None:
        feed.stop()
        feed = plan.again()
    model, sink = plan.model(), NotedSink(store)
    aside = None if model is None else SetAside(store.teaching, source)
    if aside is not None:
        sink.then = aside.keep
    teacher = None if aside is None else aside.take
    line = LineApart(feed, plan.station, model, Counting(BufferedSink(sink), teacher), None, plan.intake)
    line.start()
    try:
        stop_if(cancelled)
        lot = begin()
        totals = store.lots.totals(lot.key)
    except FruitguiError:
        line.stop(0.0)
        raise
    line.count_into(None if lot.paused else lot.key)
    if plan.again is not None:
        feed.start()
    return Begun(feed, line, lot, sink, aside, () if model is None else tuple(model.kinds.kinds), totals)


def source_name() -> str:
    """Return what unknown fruit of a run are said to come from."""
    began = QLocale().toString(QDateTime.currentDateTime(), QLocale.FormatType.ShortFormat)
    return QCoreApplication.translate("Running", "Unknown, {time}").format(time=began)
