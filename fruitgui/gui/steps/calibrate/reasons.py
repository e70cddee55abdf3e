"""Why a calibration was refused: what was seen, why that is not enough, and what to do, as whole sentences."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

from PySide6.QtCore import QCoreApplication

from fruitgui.calibration.result import PairQuality, Reason
from fruitgui.gui.numbers import THIN, number_text

translate = QCoreApplication.translate


@dataclass(frozen=True, slots=True)
class Told:
    """One reason as a person reads it.

    Attributes:
        code: of the reason; the sketch goes with it.
        seen: what was seen. why: it is not enough. remedy: what to do.
    """

    code: str
    seen: str
    why: str
    remedy: str


def told(reasons: Sequence[Reason], pairs: Sequence[PairQuality], with_belt: Collection[str]) -> list[Told]:
    """Return the reasons in words, each kind of reason once for the same sensors.

    Args:
        reasons, pairs: of the refusal.
        with_belt: the sensors whose belt was found.
    """
    by_ends = {frozenset(pair.sensors): pair for pair in pairs}
    said: dict[tuple[str, tuple[str, ...]], Told] = {}
    for reason in reasons:
        alone = reason.code == "too_little_structure" and len(reason.sensors) == 1
        if alone:
            one = _loose(reason.sensors[0]) if reason.sensors[0] in with_belt else _beltless(reason.sensors[0])
        else:
            pair = by_ends.get(frozenset(reason.sensors))
            one = Told(reason.code, _seen(reason, pair), _why(reason.code), _remedy(reason.code))
        said.setdefault((reason.code, reason.sensors), one)
    return list(said.values())


def _beltless(sensor: str) -> Told:
    return Told(
        "too_little_structure",
        translate("Calibrate", "{sensor} sees no flat surface that could be the belt.").format(sensor=sensor),
        translate("Calibrate", "What stands on a belt can only be told from it where the belt itself is seen."),
        translate("Calibrate", "Turn the sensor so that the belt fills most of its picture, and nothing hides it."),
    )


def _loose(sensor: str) -> Told:
    text = translate("Calibrate", "What {sensor} has in common with the others holds it too loosely.")
    code = "too_little_structure"
    return Told(code, text.format(sensor=sensor), _why(code), _remedy(code))


def _seen(reason: Reason, pair: PairQuality | None) -> str:
    names = ", ".join(reason.sensors)
    if reason.code in ("too_little_overlap", "too_little_structure") and pair is not None:
        text = translate("Calibrate", "{sensors}: things in common {things}, belt in common {overlap}.")
        overlap = f"{number_text(100 * pair.overlap, 0)}{THIN}%"
        return text.format(sensors=names, things=pair.things, overlap=overlap)
    texts: Mapping[str, str] = {
        "too_little_overlap": translate("Calibrate", "{sensors} have next to nothing in common."),
        "too_little_structure": translate("Calibrate", "{sensors}: too little stands on the belt."),
        "ambiguous": translate("Calibrate", "{sensors}: what they see fits together in more than one way."),
        "scene_moved": translate("Calibrate", "{sensors}: something moved while the scene was captured."),
        "disconnected": translate("Calibrate", "Nothing links all of these sensors: {sensors}."),
    }
    return texts[reason.code].format(sensors=names)


def _why(code: str) -> str:
    return {
        "too_little_overlap": translate("Calibrate", "Two sensors find each other only by what both of them see."),
        "too_little_structure": translate(
            "Calibrate", "A bare belt looks the same wherever it is seen from; fruit tell where a sensor stands."
        ),
        "ambiguous": translate("Calibrate", "A pattern that repeats itself fits as well one step farther."),
        "scene_moved": translate("Calibrate", "What has moved between two pictures puts the sensors in a wrong place."),
        "disconnected": translate("Calibrate", "Every sensor must be linked to the reference, through others or not."),
    }[code]


def _remedy(code: str) -> str:
    return {
        "too_little_overlap": translate(
            "Calibrate",
            "Turn the sensors so that at least a third of what they see is common, with five or more pieces in it.",
        ),
        "too_little_structure": translate(
            "Calibrate", "Put ten or more pieces of fruit, spread over all of the belt that the sensors see."
        ),
        "ambiguous": translate(
            "Calibrate", "Spread the fruit unevenly, of different kinds and sizes, or add one odd object."
        ),
        "scene_moved": translate("Calibrate", "Stop the belt, keep hands away, and try again."),
        "disconnected": translate(
            "Calibrate", "Add or turn a sensor so that its view links the groups, with fruit in the common part."
        ),
    }[code]
