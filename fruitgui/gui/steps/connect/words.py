"""What the screen says of sensors, as whole sentences."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QCoreApplication

from fruitgui.errors import FruitguiError
from fruitgui.gui import error_words
from fruitgui.gui.numbers import count_text, number_text
from fruitgui.sensors.feed import LOST_SHARE, SLOW_SHARE, Running, SensorHealth
from fruitgui.sensors.sensor import ColorLock
from fruitgui.station.station_file import SENSOR_ID

translate = QCoreApplication.translate


@dataclass(frozen=True, slots=True)
class Condition:
    """How something is, for people.

    Attributes:
        health: `good`, `warn`, `bad`, or empty while it is not known.
        word: in one or two words. remedy: what to do; empty where there is nothing to do.
    """

    health: str
    word: str
    remedy: str = ""


def condition(health: SensorHealth | None) -> Condition:
    """Return how a sensor is; None is one that is not there."""
    if health is None:
        return Condition(
            "bad",
            translate("Connect", "not there"),
            translate("Connect", "Plug it in again; it starts by itself when it returns."),
        )
    if health.hangs:
        return Condition(
            "bad",
            translate("Connect", "does not answer"),
            translate("Connect", "Its driver hangs. Unplug it, wait five seconds, and plug it in again."),
        )
    if health.state is Running.RUNNING:
        return _running(health)
    if health.state is Running.SILENT:
        return Condition(
            "bad",
            translate("Connect", "no pictures"),
            translate("Connect", "Check its cable and power; it is opened again by itself."),
        )
    if health.state is Running.FAILED:
        return Condition("bad", translate("Connect", "failed"), _failure(health.error))
    if health.state is Running.ENDED:
        return Condition(
            "warn",
            translate("Connect", "at its end"),
            translate("Connect", "The recording is over; start it again to see it anew."),
        )
    return Condition("", translate("Connect", "starting"))


def being_tried() -> Condition:
    """Return how a sensor is while its projector is tried: its pictures come and go, and that is as it should be."""
    return Condition("", translate("Connect", "being measured"))


def _running(health: SensorHealth) -> Condition:
    if health.blinded_by:
        text = translate("Connect", "The projector of {sensors} may be on out of its turn, as it does not answer.")
        return Condition(
            "warn", translate("Connect", "may be blinded"), text.format(sensors=", ".join(health.blinded_by))
        )
    lost = health.drops + health.damaged
    if health.useless or (health.frames > LOST_SHARE**-1 and lost > LOST_SHARE * (health.frames + lost)):
        return Condition(
            "bad" if health.useless else "warn",
            translate("Connect", "loses pictures"),
            translate("Connect", "Give it a USB controller of its own, and a shorter cable."),
        )
    if 0.0 < health.rate_hz < SLOW_SHARE * health.nominal_hz and health.frames > 3.0 * health.nominal_hz:
        return Condition(
            "warn",
            translate("Connect", "slow"),
            translate(
                "Connect", "This computer cannot keep up: close other programs, or give it a USB controller of its own."
            ),
        )
    return Condition("good", translate("Connect", "running"))


def _failure(error: FruitguiError | None) -> str:
    if error is None or error.code == "sensor_failed":
        return translate("Connect", "It is opened again by itself; if it stays away, unplug it and plug it in again.")
    told = error_words.told(error)
    return f"{told.what} {told.remedy}"


def rate_text(health: SensorHealth | None) -> str:
    """Return pictures per second, against what is promised where they are fewer: in turns, some come ahead of it."""
    if health is None:
        return "–"
    rate = number_text(health.rate_hz, 1)
    if health.rate_hz > health.nominal_hz:
        return translate("Connect", "{rate} a second").format(rate=rate)
    return translate("Connect", "{rate} of {nominal} a second").format(
        rate=rate, nominal=number_text(health.nominal_hz, 1)
    )


def short_rate_text(health: SensorHealth | None) -> str:
    """Return pictures per second where there is no room for a sentence."""
    return "" if health is None else f"{number_text(health.rate_hz, 1)}/s"


def lost_text(health: SensorHealth | None) -> str:
    """Return how many pictures were lost."""
    if health is None:
        return "–"
    lost = health.drops + health.damaged
    if not lost:
        return translate("Connect", "none of {frames}").format(frames=count_text(health.frames))
    return translate("Connect", "{drops} of {frames}").format(
        drops=count_text(lost), frames=count_text(health.frames + lost)
    )


def name_problem(name: str, others: tuple[str, ...]) -> str:
    """Return why a sensor cannot have a name; empty where it can."""
    if not name:
        return translate("Connect", "A sensor needs a name.")
    if not SENSOR_ID.fullmatch(name):
        return translate(
            "Connect", "A name has letters, digits and _ only, and begins with a letter; for example left_1."
        )
    if name in others:
        return translate("Connect", "Another sensor has this name.")
    return ""


def colour_lock(kind: str, lock: ColorLock) -> Condition:
    """Return whether exposure and white balance stay as they are."""
    if kind == "recording":
        return Condition("", translate("Connect", "as recorded"))
    if lock is ColorLock.LOCKED:
        return Condition("good", translate("Connect", "locked"))
    if lock is ColorLock.LOCKABLE:
        return Condition("", translate("Connect", "adjusting to the light"))
    if lock is ColorLock.AUTOMATIC:
        return Condition(
            "warn",
            translate("Connect", "automatic"),
            translate("Connect", "This sensor cannot lock them; colours may drift, so keep the light steady."),
        )
    return Condition(
        "warn",
        translate("Connect", "not known"),
        translate("Connect", "This driver cannot lock them; colours may drift, so keep the light steady."),
    )
