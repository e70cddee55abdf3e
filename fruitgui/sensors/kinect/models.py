"""The models of the Kinect v1, and what each cannot do."""

from __future__ import annotations

from dataclasses import dataclass

MICROSOFT = 0x045E
MOTOR = 0x02B0
_CAMERA, _CAMERA_K4W = 0x02AE, 0x02BF
_AUDIO, _AUDIO_K4W = 0x02AD, (0x02BE, 0x02C3, 0x02BB)
_RELEASE_1414 = 267


@dataclass(frozen=True, slots=True)
class Model:
    """One model.

    Attributes:
        name: for people.
        has_motor: whether LED, tilt and accelerometer answer without a firmware that nobody may hand on.
        limits: what it cannot do, a sentence each.
    """

    name: str
    has_motor: bool
    limits: tuple[str, ...]


KINECT_1414 = Model("Kinect 1414", True, ())
_BY_MICROPHONE = (
    "Its LED, tilt and accelerometer answer only with a firmware of Microsoft's that cannot be handed on: "
    "a bump is seen in the pictures only."
)
_SERIAL = "It is known by the serial of its microphone, since its camera has none."
KINECT_1473 = Model("Kinect 1473", False, (_BY_MICROPHONE, _SERIAL))
KINECT_FOR_WINDOWS = Model("Kinect for Windows", False, (_BY_MICROPHONE, _SERIAL, "Its near mode is not used."))


def camera_model(vendor: int, product: int, release: int) -> Model | None:
    """Return the model of a USB device that is a Kinect's camera; None for anything else."""
    if vendor != MICROSOFT or product not in (_CAMERA, _CAMERA_K4W):
        return None
    if product == _CAMERA_K4W:
        return KINECT_FOR_WINDOWS
    return KINECT_1414 if release == _RELEASE_1414 else KINECT_1473


def is_microphone(vendor: int, product: int) -> bool:
    """Tell whether a USB device is a Kinect's microphone."""
    return vendor == MICROSOFT and product in (_AUDIO, *_AUDIO_K4W)


def is_motor(vendor: int, product: int) -> bool:
    """Tell whether a USB device is a Kinect's motor."""
    return vendor == MICROSOFT and product == MOTOR
