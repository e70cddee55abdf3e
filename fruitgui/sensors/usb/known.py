"""Which USB devices are depth sensors, or parts of one, by the numbers that they give themselves.

Sources: the USB ID repository (linux-usb.org); the udev rules and sources of libfreenect, libfreenect2, OpenNI2,
librealsense, OrbbecSDK and depthai.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

from fruitgui.sensors.usb.tree import HIGH_SPEED_MBPS, SUPER_SPEED_MBPS, UsbDevice

MICROSOFT, PRIMESENSE, INTEL, ORBBEC, MOVIDIUS = 0x045E, 0x1D27, 0x8086, 0x2BC5, 0x03E7

RELEASE_OF_1414 = 0x010B
"""bcdDevice of the camera of the first Kinect; the later 1473 gives another."""


class Part(StrEnum):
    """What of a sensor a USB device is."""

    SENSOR = "sensor"
    MOTOR = "motor"
    OTHER = "other"


@dataclass(frozen=True, slots=True)
class KnownDevice:
    """A USB device that is a depth sensor or a part of one.

    Attributes:
        make: the word of the driver that reads it, whether or not there is one here.
        maker, model: for people.
        part: the sensor itself, or something beside it in the same housing.
        needs_mbps: speed of its port below which it gives less than it could.
    """

    make: str
    maker: str
    model: str
    part: Part = Part.SENSOR
    needs_mbps: float = HIGH_SPEED_MBPS


def _part(make: str, maker: str, model: str, part: Part) -> KnownDevice:
    return KnownDevice(make, maker, model, part, 0.0)


_KINECT = {
    0x02AE: KnownDevice("kinect", "Microsoft", "Kinect 360"),
    0x02BF: KnownDevice("kinect", "Microsoft", "Kinect for Windows"),
    0x02B0: _part("kinect", "Microsoft", "Kinect 1414", Part.MOTOR),
    0x02C2: _part("kinect", "Microsoft", "Kinect 1473 or for Windows", Part.OTHER),
    0x02AD: _part("kinect", "Microsoft", "Kinect 360", Part.OTHER),
    0x02BB: _part("kinect", "Microsoft", "Kinect", Part.OTHER),
    0x02BE: _part("kinect", "Microsoft", "Kinect for Windows", Part.OTHER),
    0x02C3: _part("kinect", "Microsoft", "Kinect for Windows", Part.OTHER),
    0x02C4: KnownDevice("kinect_v2", "Microsoft", "Kinect v2", needs_mbps=SUPER_SPEED_MBPS),
    0x02D8: KnownDevice("kinect_v2", "Microsoft", "Kinect v2", needs_mbps=SUPER_SPEED_MBPS),
    0x097C: KnownDevice("azure_kinect", "Microsoft", "Azure Kinect", needs_mbps=SUPER_SPEED_MBPS),
    0x097D: _part("azure_kinect", "Microsoft", "Azure Kinect", Part.OTHER),
    0x097E: _part("azure_kinect", "Microsoft", "Azure Kinect", Part.OTHER),
}
_REALSENSE: Mapping[int, str] = {
    0x0A66: "F200", 0x0A80: "R200", 0x0AA5: "SR300", 0x0AD1: "D400", 0x0AD2: "D410", 0x0AD3: "D415", 0x0AD4: "D430",
    0x0AD6: "D400 (USB 2)", 0x0AF6: "D420", 0x0B07: "D435", 0x0B3A: "D435i", 0x0B48: "SR305", 0x0B4B: "D430i",
    0x0B5B: "D405", 0x0B5C: "D455", 0x0B64: "L515",
}  # fmt: skip
_OAK: Mapping[int, str] = {0x2485: "OAK (asleep)", 0xF63B: "OAK", 0xF63C: "OAK", 0xF63D: "OAK"}


def known_device(device: UsbDevice) -> KnownDevice | None:
    """Return which depth sensor, or which part of one, a USB device is; None where it is none that is known."""
    vendor, product = device.vendor, device.product
    if vendor == MICROSOFT:
        return _kinect(device)
    if vendor == INTEL and (product in _REALSENSE or "RealSense" in device.name):
        model = _REALSENSE.get(product) or device.name.rpartition("RealSense")[2].strip()
        return KnownDevice("realsense", "Intel", f"RealSense {model}".strip(), needs_mbps=SUPER_SPEED_MBPS)
    if vendor == MOVIDIUS and product in _OAK:
        awake = product != 0x2485  # asleep it is a USB 2 device, whatever its socket
        return KnownDevice("oak", "Luxonis", _OAK[product], needs_mbps=SUPER_SPEED_MBPS if awake else HIGH_SPEED_MBPS)
    if vendor == ORBBEC:
        colour = product >> 8 == 0x05  # of the Astra: a webcam beside its depth camera
        return KnownDevice("orbbec", "Orbbec", device.name or "Orbbec", Part.OTHER if colour else Part.SENSOR)
    if vendor == PRIMESENSE:
        return KnownDevice("primesense", "PrimeSense", device.name or "Xtion or Carmine")
    return None


def _kinect(device: UsbDevice) -> KnownDevice | None:
    known = _KINECT.get(device.product)
    if device.product == 0x02AE and device.release:
        model = "Kinect 1414" if device.release == RELEASE_OF_1414 else "Kinect 1473"
        return KnownDevice("kinect", "Microsoft", model)
    return known
