"""What the screen shows of the sensors: plain records, made from the connection, the feed and the station."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from fruitgui.gui.steps.connect.steady_words import correction_text, light, warmth
from fruitgui.gui.steps.connect.words import (
    Condition,
    being_tried,
    colour_lock,
    condition,
    lost_text,
    rate_text,
    short_rate_text,
)
from fruitgui.sensors.feed import Feed, Running, SensorHealth
from fruitgui.sensors.sensor import ColorLock, SensorInfo
from fruitgui.station.connection import ConnectedSensor, Connection
from fruitgui.station.depths import DeviceDepths
from fruitgui.station.projectors import Projectors
from fruitgui.station.station import Station
from fruitgui.station.steadiness import Steadiness
from fruitgui.station.turn_plan import TurnPlan, rig_of, seen_length_m, turn_plan

NOT_KNOWN = Condition("", "–")


@dataclass(frozen=True, slots=True)
class SensorView:
    """One sensor as the screen shows it.

    Attributes:
        name: that a person gave. place: from 1.
        device: make and model. serial: of the device; a dash where unknown. firmware: empty where unknown.
        reference: whether the others are placed in its frame.
        condition: how it is. rate, lost: pictures a second and lost, in words. short_rate: where there is little room.
        colour: whether exposure and white balance are locked. light: whether the belt's light is as at first.
        warmth: whether its depth is steady. correction: of its depth, in words.
    """

    name: str
    place: int
    device: str
    serial: str
    reference: bool
    condition: Condition
    rate: str
    lost: str
    colour: Condition
    light: Condition = NOT_KNOWN
    warmth: Condition = NOT_KNOWN
    correction: str = ""
    short_rate: str = ""
    firmware: str = ""


def sensor_views(
    connection: Connection | None, infos: Mapping[str, SensorInfo], health: Mapping[str, SensorHealth], *, opening: bool
) -> tuple[SensorView, ...]:
    """Return the connection's sensors in order; one that is not in `infos` is not there, or not yet while opening."""
    if connection is None:
        return ()
    kind = str(connection.source.get("kind", ""))
    return tuple(
        _view(one, place, connection.reference_name, kind, infos.get(one.name), health.get(one.name), opening)
        for place, one in enumerate(connection.sensors, start=1)
    )


def _view(
    one: ConnectedSensor,
    place: int,
    reference: str,
    kind: str,
    info: SensorInfo | None,
    health: SensorHealth | None,
    opening: bool,
) -> SensorView:
    waiting = opening or (info is not None and health is None)
    return SensorView(
        name=one.name,
        place=place,
        device="–" if info is None else " ".join(part for part in (info.make, info.model) if part) or "–",
        serial=(info.serial if info is not None else "") or one.serial or "–",
        firmware="" if info is None else info.firmware,
        reference=one.name == reference,
        condition=condition(health) if not waiting else condition(_beginning(one.name)),
        rate=rate_text(health),
        short_rate=short_rate_text(health),
        lost=lost_text(health),
        colour=colour_lock(kind, ColorLock.UNKNOWN if health is None else health.color_lock),
    )


def with_steadiness(
    views: tuple[SensorView, ...], kind: str, steady: Callable[[str], Steadiness], depths: DeviceDepths
) -> tuple[SensorView, ...]:
    """Return sensors with what the watch says of them, and with what was measured of their depth."""
    return tuple(
        replace(
            view,
            light=light(kind, steady(view.name)),
            warmth=warmth(kind, steady(view.name).warmup),
            correction=correction_text(depths.of(view.serial.replace("–", ""), view.name)),
        )
        for view in views
    )


def while_tried(views: tuple[SensorView, ...], health: Mapping[str, SensorHealth]) -> tuple[SensorView, ...]:
    """Return sensors whose projectors are being tried: to be silent is no fault then, to be gone is."""
    well = {name for name, one in health.items() if one.state is not Running.FAILED and not one.hangs}
    return tuple(
        replace(view, condition=being_tried(), rate="–", short_rate="") if view.name in well else view for view in views
    )


def _beginning(name: str) -> SensorHealth:
    return SensorHealth(name, Running.STARTING)


def plan_of(feed: Feed | None, station: Station | None, projectors: Projectors) -> TurnPlan | None:
    """Return how the projectors of the sensors that run take turns; None where none runs."""
    if feed is None or not feed.infos:
        return None
    cameras = {name: info.intrinsics for name, info in feed.infos.items()}
    seen_m = {name: seen_length_m(camera, feed.newest(name)) for name, camera in cameras.items()}
    return turn_plan(
        feed.infos, seen_m, rig_of(station, cameras), projectors.known(), projectors.disturbing(feed.infos.values())
    )


def summary(views: tuple[SensorView, ...]) -> tuple[int, int]:
    """Return how many sensors run, and how many there are."""
    return sum(view.condition.health in ("good", "warn") for view in views), len(views)
