"""Why measurements of a device's depth do not do, as whole sentences."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QCoreApplication

from fruitgui.calibration.depth.measured import DepthReason
from fruitgui.gui.steps.connect.depth.words import length_name

translate = QCoreApplication.translate


def reason_words(reason: DepthReason) -> tuple[str, str]:
    """Return what is wrong with the measurements, and what to do."""
    known = {**_of_what_was_seen(), **_of_what_was_typed()}
    what, remedy = known.get(reason.code, (reason.what, reason.remedy))
    if reason.about:
        text = translate("Depth", "{what} Most in doubt: {length}.")
        what = text.format(what=what, length=length_name(reason.about))
    return what, remedy


def _of_what_was_seen() -> Mapping[str, tuple[str, str]]:
    return {
        "belt_not_seen": (
            translate("Depth", "No belt was seen."),
            translate("Depth", "Let the sensor look at the bare belt from half a metre to two metres."),
        ),
        "board_not_seen": (
            translate("Depth", "No flat lid was seen above the belt."),
            translate("Depth", "Use a flat, dull lid of at least 15 × 15 cm, level and amid the picture."),
        ),
        "ball_not_seen": (
            translate("Depth", "No ball of the typed size was seen."),
            translate("Depth", "Put one dull ball on the bare belt amid the picture, and type its diameter."),
        ),
        "not_flat": (
            translate("Depth", "Belt or lid is not flat."),
            translate("Depth", "Use a stiff board, or a place where the belt lies on its table."),
        ),
        "scene_moved": (
            translate("Depth", "Something moved while pictures were taken."),
            translate("Depth", "Stop the belt, and keep hands away."),
        ),
        "sensor_moved": (
            translate("Depth", "Sensor or belt was moved between two measurements."),
            translate("Depth", "Begin again with the bare belt."),
        ),
        "raised_belt_not_seen": (
            translate("Depth", "The belt was not seen by the raised sensor."),
            translate("Depth", "Clear the belt, and raise the sensor straight up, so that it still looks at the belt."),
        ),
    }


def _of_what_was_typed() -> Mapping[str, tuple[str, str]]:
    return {
        "height_differs": (
            translate("Depth", "The box is not as high as was typed."),
            translate("Depth", "Type the height of its upper side over the belt, in millimetres."),
        ),
        "raised_too_little": (
            translate("Depth", "The two heights of the sensor are too near to each other."),
            translate("Depth", "Raise it by 20 cm or more."),
        ),
        "raised_differs": (
            translate("Depth", "The sensor was not raised by as much as was typed."),
            translate(
                "Depth", "Measure how much higher its glass is than at first, straight up, and type it in millimetres."
            ),
        ),
        "too_few_heights": (
            translate("Depth", "One height alone tells nothing."),
            translate("Depth", "Take a box or a ball of known size, or raise the sensor, as well."),
        ),
        "nothing_decided": (
            translate("Depth", "The heights are too small to tell more than is known of such devices."),
            translate("Depth", "Use a higher box, 15 cm or more, or raise the sensor farther, and use a tape."),
        ),
        "typed_disagrees": (
            translate("Depth", "What was typed does not agree with the other measurements."),
            translate("Depth", "Measure again; see that the ball lies on the belt itself and that the lid is level."),
        ),
        "implausible": (
            translate("Depth", "No working sensor errs as much as this would mean."),
            translate("Depth", "Check what was typed, in millimetres."),
        ),
    }
