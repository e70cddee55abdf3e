"""What measuring a device's depth says, as whole sentences."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication

from fruitgui.calibration.depth.measured import LEAST_RAISED_M, DepthFit
from fruitgui.gui.numbers import THIN, number_text
from fruitgui.gui.steps.connect.depth.course import Stage, Typed
from fruitgui.gui.steps.connect.words import Condition
from fruitgui.station.depth_watch import Looked, Sight

translate = QCoreApplication.translate

OFF_SHARE = 0.2
"""A board that is read so far from what was typed is another, or a slip of the pen."""


def mm(length_m: float, decimals: int = 0) -> str:
    """Return a length in millimetres."""
    return f"{number_text(length_m * 1e3, decimals)}{THIN}mm"


def stage_name(stage: Stage) -> str:
    """Return a stage's name."""
    return {
        Stage.BELT: translate("Depth", "Belt"),
        Stage.BOARD: translate("Depth", "Box"),
        Stage.BALL: translate("Depth", "Ball"),
        Stage.RAISED: translate("Depth", "Higher"),
        Stage.RESULT: translate("Depth", "Result"),
    }[stage]


def rules(stage: Stage) -> tuple[str, ...]:
    """Return what a person does at a stage."""
    return {
        Stage.BELT: (
            translate("Depth", "1.  Stop the belt and clear it."),
            translate(
                "Depth",
                "2.  If the sensor can only be lowered, lower it by 20 cm or more now: the second height is its own "
                "place.",
            ),
            translate(
                "Depth",
                "3.  Measure from the sensor's glass straight ahead to the belt, to the cross in the picture, and type "
                "it. Leave it at 0 if you have no tape.",
            ),
        ),
        Stage.BOARD: (
            translate(
                "Depth", "1.  Put a carton or a box with a flat, dull lid amid the picture; the higher the better."
            ),
            translate("Depth", "2.  Measure the height of its upper side over the belt, and type it."),
        ),
        Stage.BALL: (
            translate("Depth", "1.  Put a dull ball on the bare belt amid the picture; a large one tells more."),
            translate("Depth", "2.  Measure its diameter between two straight edges, and type it."),
        ),
        Stage.RAISED: (
            translate(
                "Depth",
                "1.  Clear the belt, and raise the sensor straight up by 20 cm or more: on a block, or in its clamp.",
            ),
            translate("Depth", "2.  Measure how much higher its glass is now than at first, straight up, and type it."),
        ),
        Stage.RESULT: (),
    }[stage]


def seen_text(sight: Sight | None, typed: Typed) -> Condition:
    """Return what is seen now of what is looked for."""
    if sight is None:
        return Condition("", translate("Depth", "Looking…"))
    if sight.moving:
        return Condition("warn", translate("Depth", "Something moves: stop the belt, and keep hands away."))
    if sight.what is Looked.BELT:
        if sight.on is None:
            return Condition("warn", translate("Depth", "No belt is seen yet."))
        text = translate("Depth", "The belt is seen, about {length} away.")
        return Condition("good", text.format(length=mm(sight.length_m)))
    if sight.what is Looked.BOARD:
        return _board_text(sight, typed)
    if sight.what is Looked.RAISED:
        return _raised_text(sight, typed)
    if sight.on is None:
        text = translate("Depth", "No ball of {length} is seen yet.")
        return Condition("warn", text.format(length=mm(typed.diameter_mm * 1e-3)))
    return Condition("good", translate("Depth", "The ball is seen."))


def _board_text(sight: Sight, typed: Typed) -> Condition:
    if sight.on is None:
        return Condition("warn", translate("Depth", "No flat lid above the belt is seen yet."))
    if abs(sight.length_m * 1e3 - typed.height_mm) > OFF_SHARE * typed.height_mm:
        text = translate("Depth", "A lid is seen about {length} above the belt; that is not what is typed.")
        return Condition("warn", text.format(length=mm(sight.length_m)))
    text = translate("Depth", "The lid is seen, about {length} above the belt.")
    return Condition("good", text.format(length=mm(sight.length_m)))


def _raised_text(sight: Sight, typed: Typed) -> Condition:
    if typed.raised_mm < 1e3 * LEAST_RAISED_M:
        text = translate("Depth", "The two heights are too near to each other: raise it by {length} or more.")
        return Condition("warn", text.format(length=mm(LEAST_RAISED_M)))
    if sight.on is None:
        return Condition("warn", translate("Depth", "The belt is not seen from there: let the sensor look at it."))
    if sight.length_m < -OFF_SHARE * LEAST_RAISED_M:
        text = translate("Depth", "The sensor hangs lower than at first: begin again from here, then raise it.")
        return Condition("warn", text)
    if sight.length_m < OFF_SHARE * LEAST_RAISED_M:
        return Condition("warn", translate("Depth", "The sensor hangs where it was: raise it."))
    text = translate("Depth", "The belt is seen about {length} farther away.")
    if abs(sight.length_m * 1e3 - typed.raised_mm) > OFF_SHARE * typed.raised_mm:
        text = translate("Depth", "The belt is seen about {length} farther away; that is not what is typed.")
        return Condition("warn", text.format(length=mm(sight.length_m)))
    return Condition("good", text.format(length=mm(sight.length_m)))


def figure_name(what: str) -> str:
    """Return what a figure is of."""
    return {
        "distance": translate("Depth", "Distance of the belt"),
        "height": translate("Depth", "Height of the box"),
        "raised": translate("Depth", "How far the sensor was raised"),
        "ball": translate("Depth", "Diameter of the ball"),
        "flatness": translate("Depth", "Unevenness of the belt"),
    }[what]


def length_name(what: str) -> str:
    """Return what a typed length is of, within a sentence."""
    return {
        "distance": translate("Depth", "the distance of the belt"),
        "height": translate("Depth", "the height of the box"),
        "raised": translate("Depth", "how far the sensor was raised"),
        "ball": translate("Depth", "the diameter of the ball"),
    }[what]


def verdict_text(fit: DepthFit) -> str:
    """Return how sure depth is now."""
    text = translate(
        "Depth",
        "Depth at the belt is now right to ±{after}; without a measurement such a sensor may be off by ±{before}.",
    )
    return text.format(after=mm(1.96 * fit.depth_std_m), before=mm(1.96 * fit.depth_std_before_m))


def sureness_name(by: str, heights: int) -> str:
    """Return by what part of the measurements something is known."""
    text = {
        "belt": translate("Depth", "one height alone"),
        "heights": translate("Depth", "{count} heights"),
        "ball": translate("Depth", "one height and the ball"),
        "all": translate("Depth", "all of it"),
    }[by]
    return text.format(count=number_text(heights, 0))


def terms_text(fit: DepthFit) -> str:
    """Return the terms that were fitted."""
    told = fit.correction
    parts = []
    if "scale" in fit.decided:
        value, half = (number_text(100.0 * one, 2) for one in (told.scale - 1.0, 1.96 * fit.std("scale")))
        parts.append(translate("Depth", "scale {value} ± {half} %").format(value=value, half=half))
    if "offset_m" in fit.decided:
        value, half = (number_text(1e3 * one, 1) for one in (told.offset_m, 1.96 * fit.std("offset_m")))
        parts.append(translate("Depth", "offset {value} ± {half} mm").format(value=value, half=half))
    if "radial_2" in fit.decided:
        value, half = (number_text(30.0 * one, 2) for one in (told.radial_2, 1.96 * fit.std("radial_2")))
        parts.append(translate("Depth", "bend at the picture's edge {value} ± {half} %").format(value=value, half=half))
    return "; ".join(parts)


def missing_texts(fit: DepthFit) -> tuple[str, ...]:
    """Return what would decide more."""
    known = {
        "distance": translate(
            "Depth", "Without a tape or a large ball the offset stays unknown: heights are right, widths less."
        ),
        "height": translate("Depth", "A higher box, or the sensor raised farther, would tell the scale."),
        "wider": translate("Depth", "The belt fills too little of the picture to tell how it bends."),
    }
    return tuple(known[one] for one in fit.missing.values())
