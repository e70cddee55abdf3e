"""Checkups as they are found on packing floors, to draw the screen with."""

from __future__ import annotations

from fruitgui.sensors.usb.problems import problem
from fruitgui.station.checkup.records import (
    CheckedController,
    CheckedSensor,
    Checkup,
    Measured,
    SensorState,
    UsbPlace,
)

ON_BOARD, CARD = "0000:00:14.0", "0000:05:00.0"


def _kinect(number: int, serial: str, place: UsbPlace) -> CheckedSensor:
    measured = Measured(29.97, 30.0, 120, 0)
    return CheckedSensor(
        f"kinect_{number}",
        "kinect",
        "Kinect 1414",
        serial,
        SensorState.RUNNING,
        firmware="1.14",
        measured=measured,
        place=place,
    )


def all_well() -> Checkup:
    """Return two Kinects, each on a controller of its own."""
    sensors = (
        _kinect(1, "A00363A01205", UsbPlace(1, ON_BOARD, "1-4.3", 480.0)),
        _kinect(2, "A00364A22105", UsbPlace(3, CARD, "3-1.3", 480.0)),
    )
    controllers = (
        CheckedController(ON_BOARD, "xhci_hcd", (1, 2), ("kinect_1",), 0.73),
        CheckedController(CARD, "xhci_hcd", (3, 4), ("kinect_2",), 0.73),
    )
    return Checkup(sensors, (), controllers)


def much_wrong() -> Checkup:
    """Return a rig on which nearly everything is wrong that can be."""
    limit = "Its LED, tilt and accelerometer answer only with a firmware of Microsoft's that cannot be handed on."
    lossy = Measured(21.4, 30.0, 86, 34)
    sensors = (
        _kinect(1, "A00363A01205", UsbPlace(1, ON_BOARD, "1-4.3", 480.0)),
        CheckedSensor(
            "kinect_2", "kinect", "Kinect 1473", "A00364A22105", SensorState.RUNNING,
            (problem("slow", rate="21.4", nominal="30.0"), problem("loses", lost="34", all="120")), (limit,),
            measured=lossy, place=UsbPlace(1, ON_BOARD, "1-2.3", 480.0),
        ),
        CheckedSensor(
            "kinect_3", "kinect", "Kinect for Windows", "", SensorState.NO_ACCESS, (problem("no_access"),),
            place=UsbPlace(3, CARD, "3-1.3", 480.0),
        ),
        CheckedSensor(
            "realsense_1", "realsense", "RealSense D435", "923322071108", SensorState.BUSY,
            (
                problem("busy", programs="cheese (process 4711)"),
                problem("slow_port", speed="480", needed="5000", usb="3"),
            ),
            place=UsbPlace(1, ON_BOARD, "1-6", 480.0),
        ),
    )  # fmt: skip
    full = problem("bus_full", sensors="kinect_1, kinect_2", controller=f"{ON_BOARD}, bus 1", free=CARD)
    controllers = (
        CheckedController(ON_BOARD, "xhci_hcd", (1, 2), ("kinect_1", "kinect_2", "realsense_1"), 1.46),
        CheckedController(CARD, "xhci_hcd", (3, 4), ("kinect_3",), 0.73),
    )
    return Checkup(sensors, (problem("no_power"), full), controllers)


def nothing() -> Checkup:
    """Return what is found where nothing is plugged in."""
    controllers = (CheckedController(ON_BOARD, "xhci_hcd", (1, 2), ()),)
    return Checkup((), (problem("nothing_connected"),), controllers)
