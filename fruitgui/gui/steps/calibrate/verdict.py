"""How good a calibration is: words first, figures second."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from PySide6.QtCore import QCoreApplication

from fruitgui.calibration.result import PairQuality, SensorQuality
from fruitgui.gui.numbers import THIN, number_text
from fruitgui.gui.widgets.rig_graph import GraphLink, GraphNode
from fruitgui.station.calibrate_job import CalibrationOutcome
from fruitgui.station.connection import Connection
from fruitgui.station.station import Station

translate = QCoreApplication.translate

GOOD_LINK_M, USABLE_LINK_M = 0.001, 0.002
"""What a link may err by to be good, and to be usable: calibration is held to 2 mm."""


@dataclass(frozen=True, slots=True)
class Verdict:
    """What a person is told of a calibration.

    Attributes:
        health: `good`, `warn` or `bad`.
        word: good, usable or redo, in the operator's language.
        sentence: what that rests on.
        figures: (name, value) of what was measured.
    """

    health: str
    word: str
    sentence: str
    figures: tuple[tuple[str, str], ...]


def verdict_of(outcome: CalibrationOutcome) -> Verdict:
    """Return the verdict on what calibrating came to."""
    if not outcome.accepted:
        return Verdict("bad", _word("bad"), translate("Calibrate", "The sensors could not be placed."), ())
    used = [pair for pair in outcome.pairs if pair.accepted]
    words = {quality.word for quality in outcome.sensors.values()}
    links = {link_health(pair) for pair in used}
    health = "good" if words == {"good"} and links <= {"good"} else "warn"
    position_m = max((one.position_std_m for one in outcome.sensors.values()), default=0.0)
    angle_rad = max((one.angle_std_rad for one in outcome.sensors.values()), default=0.0)
    flat_m = max((one.surface_rms_m for one in outcome.sensors.values()), default=0.0)
    return _accepted(health, len(outcome.sensors), position_m, angle_rad, flat_m, used)


def verdict_of_station(station: Station) -> Verdict:
    """Return the verdict on a station that was kept, as far as its file tells."""
    qualities = [one.quality for one in station.sensors.values()]
    words = {str(quality.get("word", "usable")) for quality in qualities}
    health = "good" if words == {"good"} else "warn"
    position_m, angle_rad, flat_m = (
        max((_number(quality, name) for quality in qualities), default=0.0)
        for name in ("position_std_m", "angle_std_rad", "surface_rms_m")
    )
    used = kept_links(station)
    if not {link_health(pair) for pair in used} <= {"good"}:
        health = "warn"
    return _accepted(health, len(qualities), position_m, angle_rad, flat_m, used)


def kept_links(station: Station) -> list[PairQuality]:
    """Return the links of a station that was kept, as far as its file tells; each once."""
    pairs: dict[frozenset[str], PairQuality] = {}
    for name, sensor in station.sensors.items():
        links = sensor.quality.get("links")
        for other, one in links.items() if isinstance(links, Mapping) else ():
            if other in station.sensors and isinstance(one, Mapping):
                pairs[frozenset((name, other))] = PairQuality(
                    sensors=(name, other),
                    accepted=True,
                    things=int(_number(one, "things")),
                    overlap=_number(one, "overlap"),
                    residual_m=_number(one, "residual_m"),
                    held_out_m=_number(one, "held_out_m"),
                    scale=_number(one, "scale") or 1.0,
                    scale_std=_number(one, "scale_std") or math.inf,
                    margin=_number(one, "margin"),
                )
    return list(pairs.values())


def _accepted(
    health: str, count: int, position_m: float, angle_rad: float, flat_m: float, used: Sequence[PairQuality]
) -> Verdict:
    flat = (translate("Calibrate", "Belt flat within"), _mm(flat_m))
    if count < 2:
        sentence = translate("Calibrate", "One sensor, and the belt that it sees.")
        return Verdict(health, _word(health), sentence, (flat,))
    held = max((error_m for pair in used if (error_m := link_error_m(pair)) is not None), default=None)
    figures = [
        (translate("Calibrate", "Placed within (95 %)"), f"±{THIN}{_mm(1.96 * position_m)}"),
        (translate("Calibrate", "Turned within (95 %)"), f"±{THIN}{number_text(math.degrees(1.96 * angle_rad), 2)}°"),
        *([] if held is None else [(translate("Calibrate", "Checked on pieces held out"), _mm(held))]),
        flat,
    ]
    return Verdict(health, _word(health), _sentence(health), tuple(figures))


def _sentence(health: str) -> str:
    if health == "good":
        return translate("Calibrate", "The sensors agree; fruit are measured as if by one.")
    return translate("Calibrate", "It works; more fruit in the common view would make it better.")


def _word(health: str) -> str:
    return {
        "good": translate("Calibrate", "Good"),
        "warn": translate("Calibrate", "Usable"),
        "bad": translate("Calibrate", "Redo"),
    }[health]


def link_error_m(pair: PairQuality) -> float | None:
    """Return what a link errs by: what was held out lies off by so much; without enough to hold out, the residual."""
    error_m = pair.held_out_m if pair.things >= 2 and math.isfinite(pair.held_out_m) else pair.residual_m
    return error_m if math.isfinite(error_m) and error_m > 0 else None


def link_health(pair: PairQuality) -> str:
    """Return the health of a link; empty where it was not used."""
    error_m = link_error_m(pair)
    if not pair.accepted or error_m is None:
        return ""
    if error_m <= GOOD_LINK_M:
        return "good"
    return "warn" if error_m <= USABLE_LINK_M else "bad"


def graph_of(
    sensors: Sequence[str], reference: str, qualities: Mapping[str, SensorQuality], pairs: Sequence[PairQuality],
    blamed: Sequence[tuple[str, ...]] = (),
) -> tuple[list[GraphNode], list[GraphLink]]:  # fmt: skip
    """Return the graph of a calibration.

    Args:
        sensors: in order. reference: of them.
        qualities: by sensor, as far as known. pairs: that were tried.
        blamed: the sensors that each reason of a refusal names.
    """
    bad_pairs = {frozenset(one) for one in blamed if len(one) == 2}
    bad_sensors = {one[0] for one in blamed if len(one) == 1}
    nodes = [_node(name, name == reference, qualities.get(name), name in bad_sensors) for name in sensors]
    links = []
    for pair in pairs:
        first, second = pair.sensors
        health = "bad" if frozenset(pair.sensors) in bad_pairs else link_health(pair)
        error_m = link_error_m(pair)
        figure = _mm(error_m) if pair.accepted and error_m is not None else ""
        links.append(GraphLink((first, second), health, figure))
    return nodes, links


def outcome_graph(
    outcome: CalibrationOutcome, connection: Connection | None
) -> tuple[list[GraphNode], list[GraphLink]]:  # fmt: skip
    """Return the graph of what calibrating came to; a connection says in which order its sensors are."""
    sensors = list(outcome.sensors) or sorted({name for one in outcome.reasons for name in one.sensors})
    reference = outcome.station.reference if outcome.station is not None else ""
    if connection is not None:
        sensors, reference = [one.name for one in connection.sensors], connection.reference_name
    blamed = [one.sensors for one in outcome.reasons]
    return graph_of(sensors, reference, outcome.sensors, outcome.pairs, blamed)


def _node(name: str, reference: bool, quality: SensorQuality | None, bad: bool) -> GraphNode:
    if bad:
        return GraphNode(name, translate("Calibrate", "in doubt"), "bad", reference)
    if quality is None or quality.word == "unlinked":
        return GraphNode(name, "", "", reference)
    if reference:
        return GraphNode(name, translate("Calibrate", "reference"), "good", reference)
    health = "good" if quality.word == "good" else "warn"
    return GraphNode(name, f"±{THIN}{_mm(1.96 * quality.position_std_m)}", health, reference)


def station_graph(station: Station) -> tuple[list[GraphNode], list[GraphLink]]:
    """Return the graph of a station that was kept."""
    nodes = []
    for name, sensor in station.sensors.items():
        reference = name == station.reference
        word = str(sensor.quality.get("word", ""))
        spread = f"±{THIN}{_mm(1.96 * _number(sensor.quality, 'position_std_m'))}"
        note = translate("Calibrate", "reference") if reference else spread
        nodes.append(GraphNode(name, note, "good" if word == "good" else "warn", reference))
    _, links = graph_of((), station.reference, {}, kept_links(station))
    return nodes, links


def _number(quality: Mapping[str, Any], name: str) -> float:
    value = quality.get(name)
    return float(value) if isinstance(value, (int, float)) else 0.0


def _mm(metres: float) -> str:
    return f"{number_text(metres * 1e3, 1)}{THIN}mm"
