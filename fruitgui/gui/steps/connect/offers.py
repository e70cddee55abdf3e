"""What can be connected, as a person reads it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QCoreApplication

from fruitgui.station.sources import DevicesSource, SimulatedSource, Source

translate = QCoreApplication.translate

MAKES = {"kinect": "Kinect", "realsense": "RealSense", "orbbec": "Orbbec", "oak": "OAK"}
"""What a make calls itself."""

DEVICES = "devices"
RECORDING = "recording"
SIMULATED = "simulated"


@dataclass(frozen=True, slots=True)
class Offer:
    """One line of the list.

    Attributes:
        key: stable. icon: its drawing. name, what: its name, and one line on it.
        sources: that it stands for; a device has one, the simulated rig one for each of its presets.
    """

    key: str
    icon: str
    name: str
    what: str
    sources: tuple[Source, ...] = ()


def offers(found: Sequence[Source]) -> list[Offer]:
    """Return devices first, then a recording, then the simulated rig."""
    simulated = tuple(one for one in found if one.kind == SIMULATED)
    devices = [one for one in found if one.kind not in (SIMULATED, RECORDING)]
    listed = [_device_offer(one) for one in devices]
    listed.append(
        Offer(
            RECORDING,
            "folder",
            translate("Connect", "Recording"),
            translate("Connect", "A file, played as if its sensors were there"),
        )
    )
    if simulated:
        name = translate("Connect", "Simulated rig")
        what = translate("Connect", "Sensors and fruit that do not exist, to learn and to try")
        listed.append(Offer(SIMULATED, "cube", name, what, simulated))
    return listed


def _device_offer(source: Source) -> Offer:
    if not isinstance(source, DevicesSource):
        return Offer(f"{source.kind} {source.name}", "camera", source.name, source.kind, (source,))
    makes = Counter(MAKES.get(one.make, one.make) for one in source.devices)
    name = ", ".join(make if number == 1 else f"{number} × {make}" for make, number in makes.items())
    return Offer(DEVICES, "camera", name, translate("Connect", "Sensors that are plugged in"), (source,))


def device_lines(offer: Offer) -> list[str]:
    """Return make and serial of each device of an offer."""
    devices = (one for source in offer.sources if isinstance(source, DevicesSource) for one in source.devices)
    return [f"{MAKES.get(one.make, one.make)}  {one.serial}" for one in devices]


def supported_text(found: Sequence[Source]) -> str:
    """Return what is supported now: it says honestly where no device can be found."""
    if any(one.kind not in (SIMULATED, RECORDING) for one in found):
        return translate(
            "Connect", "Devices that are plugged in appear here by themselves. If one does not, press “Check sensors…”."
        )
    return translate(
        "Connect",
        "No device was found. Plug your sensors in and they appear here by themselves; if one does not, press “Check "
        "sensors…”. Recordings (MCAP of ROS 2, bag of ROS 1) and the simulated rig work without any.",
    )


def preset_name(source: Source) -> str:
    """Return what a simulated rig looks like, in words."""
    names = {
        "single": translate("Connect", "One sensor"),
        "opposed": translate("Connect", "Two sensors, facing each other"),
        "chain": translate("Connect", "Three sensors along the belt"),
        "ring": translate("Connect", "Four sensors in a ring"),
        "opposed_touching": translate("Connect", "Two sensors, fruit that touch, and other things"),
        "opposed_fast": translate("Connect", "Two sensors over a fast belt"),
        "opposed_projectors": translate("Connect", "Two sensors whose projectors take turns"),
        "depth_off": translate("Connect", "Two sensors whose depth is off"),
    }
    return names.get(source.name, source.name)


def as_simulated(source: Source | None) -> SimulatedSource | None:
    """Return a source as the simulated rig that it is, or None."""
    return source if isinstance(source, SimulatedSource) else None
