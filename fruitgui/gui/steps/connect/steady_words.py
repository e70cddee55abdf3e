"""What the screen says of a sensor's warming up, of the light on the belt, and of its depth correction."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication

from fruitgui.calibration.warmup import Warmth, Warmup
from fruitgui.gui.numbers import THIN, number_text
from fruitgui.gui.steps.connect.words import Condition
from fruitgui.gui.times import duration_text, moment_text
from fruitgui.station.depths import DeviceDepth
from fruitgui.station.steadiness import Steadiness

translate = QCoreApplication.translate


def warmth(kind: str, now: Warmup) -> Condition:
    """Return whether a sensor's depth is steady."""
    if kind == "recording":
        return Condition("", translate("Connect", "as recorded"))
    if now.state is Warmth.STEADY:
        text = translate("Connect", "steady for {time}")
        return Condition("good", text.format(time=duration_text(now.since_s)))
    if now.state is Warmth.DRIFTING and now.rate_m_s is not None:
        rate = f"{number_text(abs(now.rate_m_s) * 6e4, 2)}{THIN}mm"
        return Condition(
            "warn",
            translate("Connect", "{rate} a minute").format(rate=rate),
            translate("Connect", "Wait until its depth is steady before you calibrate or correct it."),
        )
    if now.watched_s > 0.0:
        text = translate("Connect", "watched for {time}")
        return Condition("", text.format(time=duration_text(now.watched_s)))
    return Condition("", translate("Connect", "not watched yet"))


def light(kind: str, now: Steadiness) -> Condition:
    """Return whether the light on the belt is as it was at first."""
    drift = now.light
    if kind == "recording":
        return Condition("", translate("Connect", "as recorded"))
    if drift is None:
        return Condition("", translate("Connect", "not known yet"))
    remedy = translate("Connect", "Bring the light back, or start the sensors again so that they adjust to it.")
    if drift.white_off:
        return Condition("warn", translate("Connect", "belt of another colour than at first"), remedy)
    if drift.brightness_off and drift.brightness > 1.0:
        return Condition("warn", translate("Connect", "belt much brighter than at first"), remedy)
    if drift.brightness_off:
        return Condition("warn", translate("Connect", "belt much darker than at first"), remedy)
    return Condition("good", translate("Connect", "as at first"))


def correction_text(depth: DeviceDepth | None) -> str:
    """Return when a device's depth was corrected, and how well."""
    if depth is None or depth.correction is None:
        return translate("Connect", "not corrected")
    if depth.depth_std_m is None:
        return translate("Connect", "corrected")
    half = f"±{THIN}{number_text(1.96e3 * depth.depth_std_m, 0)}{THIN}mm"
    if depth.measured_at is None:
        return translate("Connect", "corrected, {half}").format(half=half)
    day = moment_text(depth.measured_at.timestamp()).rsplit(" ", 1)[0]
    return translate("Connect", "corrected, {half}, {day}").format(half=half, day=day)
