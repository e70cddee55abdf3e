"""What the meter shows before calibrating: plain data, made from what was seen of the sensors."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QCoreApplication

from fruitgui.calibration.outlook import ENOUGH_COMMON, LEAST_COMMON, Outlook
from fruitgui.gui.widgets.rig_graph import GraphLink, GraphNode
from fruitgui.station.outlook_watch import RigOutlook

translate = QCoreApplication.translate

CHANCE = 2
"""So many things of any two arrangements can be laid on each other."""


@dataclass(frozen=True, slots=True)
class Prospect:
    """The meter.

    Attributes:
        nodes, links: the graph.
        health: `good`, `warn`, `bad`, or empty while nothing was seen yet.
        sentence: what that comes to.
    """

    nodes: tuple[GraphNode, ...]
    links: tuple[GraphLink, ...]
    health: str
    sentence: str


def prospect_of(sensors: Sequence[str], reference: str, seen: RigOutlook | None) -> Prospect:
    """Return the meter; `seen` is None while nothing was seen yet."""
    if seen is None:
        nodes = tuple(GraphNode(name, "", "", name == reference) for name in sensors)
        return Prospect(nodes, (), "", translate("Calibrate", "Looking at the belt …"))
    nodes = tuple(_node(name, name == reference, seen.sensors.get(name)) for name in sensors)
    links = tuple(_link(pair, count) for pair, count in seen.common.items() if set(pair) <= set(sensors))
    return Prospect(nodes, links, *_sentence(sensors, seen, links))


def _node(name: str, reference: bool, one: Outlook | None) -> GraphNode:
    if one is None:
        return GraphNode(name, "", "", reference)
    if not one.belt:
        return GraphNode(name, translate("Calibrate", "no belt in view"), "bad", reference)
    if one.moved:
        return GraphNode(name, translate("Calibrate", "something moves"), "warn", reference)
    note = translate("Calibrate", "{things} pieces").format(things=one.things)
    return GraphNode(name, note, "good" if one.things >= LEAST_COMMON else "warn", reference)


def _link(pair: tuple[str, str], count: int) -> GraphLink:
    if count <= CHANCE:
        return GraphLink(pair)
    if count >= ENOUGH_COMMON:
        return GraphLink(pair, "good", str(count))
    return GraphLink(pair, "warn" if count >= LEAST_COMMON else "bad", str(count))


def _sentence(sensors: Sequence[str], seen: RigOutlook, links: Sequence[GraphLink]) -> tuple[str, str]:
    blind = [name for name, one in seen.sensors.items() if not one.belt]
    if blind:
        text = translate("Calibrate", "No belt is in view of {sensors}.")
        return "bad", text.format(sensors=", ".join(blind))
    if seen.moved:
        return "warn", translate("Calibrate", "Something moves. Stop the belt and keep hands away.")
    if len(sensors) == 1:
        return "good", translate("Calibrate", "The belt is in view. Press Calibrate.")
    if _linked(sensors, links, ("good",)):
        return "good", translate("Calibrate", "That is plenty. Press Calibrate.")
    if _linked(sensors, links, ("good", "warn")):
        return "warn", translate("Calibrate", "That may do. More fruit where the views overlap would be better.")
    return "bad", translate("Calibrate", "That is little. Put more fruit where the views overlap.")


def _linked(sensors: Sequence[str], links: Sequence[GraphLink], healths: tuple[str, ...]) -> bool:
    """Tell whether links of some healths hold all sensors together."""
    reached = {sensors[0]}
    good = [set(link.ends) for link in links if link.health in healths]
    for _ in sensors:
        for ends in good:
            reached |= ends if ends & reached else set()
    return reached >= set(sensors)
