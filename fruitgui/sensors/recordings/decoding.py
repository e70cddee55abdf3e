"""One sensor's pairs made into frames."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.errors import InputError
from fruitgui.frame import U16, Frame, Intrinsics
from fruitgui.geometry.pose import Pose
from fruitgui.sensors.depth_correction import DepthCorrection
from fruitgui.sensors.recordings.cameras import intrinsics_of, resized
from fruitgui.sensors.recordings.pairing import Pair
from fruitgui.sensors.recordings.pictures import decode_color, decode_depth, picture_size
from fruitgui.sensors.recordings.raw import MalformedError
from fruitgui.sensors.recordings.survey import Survey
from fruitgui.sensors.recordings.topics import SensorTopics
from fruitgui.sensors.recordings.wire import Picture, read_picture
from fruitgui.sensors.registration import Registration

_MOST_BYTES_PER_PIXEL = 8
_MOST_HEAD_BYTES = 1024 * 1024


class UnusableSensorError(Exception):
    """A sensor of a recording cannot be read; `what`, `where` and `remedy` say why. Never leaves the recordings."""

    def __init__(self, what: str, where: str, remedy: str) -> None:
        super().__init__(what)
        self.what, self.where, self.remedy = what, where, remedy

    def as_input_error(self, file: str) -> InputError:
        """Return the error that a person sees."""
        return InputError("unusable_sensor", self.what, self.remedy, file=file, where=self.where)


@dataclass(frozen=True, slots=True)
class Decoder:
    """Makes the frames of one sensor.

    Attributes:
        sensor: its id.
        intrinsics: of the colour camera at the size of its pictures.
        registration: of depth to colour, None where depth is registered already.
    """

    sensor: str
    intrinsics: Intrinsics
    registration: Registration | None

    def decode(self, pair: Pair, sequence: int, correction: DepthCorrection | None) -> Frame:
        """Return the frame. Raises `MalformedError` where it cannot be decoded."""
        color_picture, depth_picture = read_picture(pair.color), read_picture(pair.depth)
        self._check_size(color_picture)
        depth_mm = self._depth(depth_picture, correction)
        color = decode_color(color_picture)
        return Frame(self.sensor, sequence, pair.time_ns / 1_000_000_000, color, depth_mm, self.intrinsics)

    def check_bytes(self, count: int, *, depth: bool) -> None:
        """Raise `MalformedError` where a message is far larger than its picture: it is not to be held."""
        camera = self.registration.depth if depth and self.registration is not None else self.intrinsics
        if count > camera.width * camera.height * _MOST_BYTES_PER_PIXEL + _MOST_HEAD_BYTES:
            raise MalformedError("a message is far larger than its picture")

    def _check_size(self, picture: Picture) -> None:
        if picture_size(picture) != (self.intrinsics.width, self.intrinsics.height):
            raise MalformedError("a colour picture has another size than the first")

    def _depth(self, picture: Picture, correction: DepthCorrection | None) -> U16:
        camera = self.intrinsics if self.registration is None else self.registration.depth
        if picture_size(picture) != (camera.width, camera.height):
            raise MalformedError("a depth picture has another size than the first")
        depth_mm = decode_depth(picture)
        if correction is not None:
            depth_mm = correction.apply(depth_mm, camera)
        return depth_mm if self.registration is None else self.registration.apply(depth_mm)


def decoder_of(sensor: str, topics: SensorTopics, seen: Survey) -> Decoder:
    """Return how the frames of a sensor are made. Raises `UnusableSensorError`."""
    _require(sensor, topics, seen)
    color = _camera(topics.color_info, topics.color, seen)
    return Decoder(sensor, color, _registration(sensor, topics, seen, color))


def _require(sensor: str, topics: SensorTopics, seen: Survey) -> None:
    """Check that colour and depth and the colour camera's matrix are there."""
    for topic, what in ((topics.color, "colour"), (topics.depth, "depth")):
        if not topic or topic not in seen.types:
            raise UnusableSensorError(
                f"The recording holds no {what} of sensor {sensor}.", topic or f"/{sensor}",
                "Record it with colour and depth, or name its topics with --topics.",
            )  # fmt: skip
        if seen.size(topic) is None:
            fault = seen.faults.get(topic, "no picture came")
            raise UnusableSensorError(
                f"The recording holds no readable {what} of sensor {sensor}: {fault}.", topic,
                "Record it again in one of the formats that the manual names.",
            )  # fmt: skip


def _camera(info_topic: str, pictures_topic: str, seen: Survey) -> Intrinsics:
    info = seen.cameras.get(info_topic)
    if info is None:
        fault = f" ({seen.faults[info_topic]})" if info_topic in seen.faults else ""
        raise UnusableSensorError(
            f"The recording holds no camera_info for {pictures_topic}{fault}.", info_topic,
            f"Record {info_topic} too, or name the topic that holds it with --topics.",
        )  # fmt: skip
    try:
        return intrinsics_of(info, _size(pictures_topic, seen), rectified=_is_rectified(pictures_topic))
    except MalformedError as error:
        raise UnusableSensorError(
            f"{info_topic} cannot be used: {error}.", info_topic, "Calibrate that camera and record again."
        ) from error


def _size(topic: str, seen: Survey) -> tuple[int, int]:
    return seen.size(topic) or (0, 0)


def _is_rectified(topic: str) -> bool:
    return any(part.startswith("image_rect") for part in topic.split("/"))


def _registration(sensor: str, topics: SensorTopics, seen: Survey, color: Intrinsics) -> Registration | None:
    """Return how depth comes into the colour picture, None where it is there already."""
    size = _size(topics.depth, seen)
    if topics.depth_info:
        depth, pose = _camera(topics.depth_info, topics.depth, seen), seen.pose_of_depth(topics)
        if pose is None:
            raise _unplaced(sensor, topics, seen)
        return None if depth == color and _is_identity(pose) else Registration(depth, color, pose)
    if size == (color.width, color.height):
        return None
    try:
        return Registration(resized(color, size), color, Pose.exact())
    except MalformedError as error:
        raise UnusableSensorError(
            f"{topics.depth} is not registered to colour: {error}.", topics.depth,
            "Record depth registered to colour, or with the camera_info of its own camera.",
        ) from error  # fmt: skip


def _is_identity(pose: Pose) -> bool:
    return bool(np.allclose(pose.matrix, np.eye(4), atol=1e-6))


def _unplaced(sensor: str, topics: SensorTopics, seen: Survey) -> UnusableSensorError:
    depth, color = seen.frames_of(topics)
    return UnusableSensorError(
        f"Depth of sensor {sensor} is in a camera of its own ({depth!r}), and /tf_static does not say "
        f"where that is from the colour camera ({color!r}).", "/tf_static",
        "Record /tf_static too, or record depth registered to colour.",
    )  # fmt: skip
