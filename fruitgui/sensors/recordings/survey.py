"""A first look at a recording: which sensors are in it, and what it takes to read each."""

from __future__ import annotations

import itertools
import statistics
from collections import Counter
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field

from fruitgui.geometry.pose import Pose
from fruitgui.sensors.recordings.pictures import picture_size
from fruitgui.sensors.recordings.raw import Container, MalformedError, RawMessage
from fruitgui.sensors.recordings.topics import (
    CAMERA_INFO_TYPE,
    PICTURE_TYPES,
    TRANSFORMS_TOPICS,
    TRANSFORMS_TYPE,
    SensorTopics,
    find_sensors,
)
from fruitgui.sensors.recordings.transforms import find_pose
from fruitgui.sensors.recordings.wire import (
    CameraInfo,
    Picture,
    Transform,
    read_camera_info,
    read_picture,
    read_transforms,
)

_ENOUGH_STAMPS = 6
_LOOK_NS = 5_000_000_000
_LOOK_BYTES = 512 * 1024 * 1024
_CHECK_BYTES = 4 * 1024 * 1024


@dataclass(slots=True)
class Survey:
    """What the beginning of a recording holds.

    Attributes:
        types: type name by topic.
        sizes_met: how often each (width, height) was met among the first pictures of each topic.
        frame_ids: frame of that picture.
        stamps_ns: first stamps of each topic, at most a few.
        cameras: what each camera_info topic says.
        transforms: all static transforms met.
        faults: the last fault met on a topic.
    """

    types: dict[str, str] = field(default_factory=dict)
    sizes_met: dict[str, Counter[tuple[int, int]]] = field(default_factory=dict)
    frame_ids: dict[str, str] = field(default_factory=dict)
    stamps_ns: dict[str, list[int]] = field(default_factory=dict)
    cameras: dict[str, CameraInfo] = field(default_factory=dict)
    transforms: list[Transform] = field(default_factory=list)
    faults: dict[str, str] = field(default_factory=dict)

    def size(self, topic: str) -> tuple[int, int] | None:
        """Return the size of most of the first pictures: a single one may lie. None where there is no picture."""
        met = self.sizes_met.get(topic)
        return met.most_common(1)[0][0] if met else None

    def rate_hz(self, topic: str) -> float:
        """Return the frame rate by the first stamps, 0 where they do not say."""
        stamps = sorted(set(self.stamps_ns.get(topic, ())))
        gaps = [after - before for before, after in itertools.pairwise(stamps)]
        return 1e9 / statistics.median(gaps) if gaps else 0.0

    def unstamped(self, topic: str) -> bool:
        """Tell whether the headers of a topic hold no time: several pictures, all stamped zero."""
        stamps = self.stamps_ns.get(topic, ())
        return len(stamps) > 1 and not any(stamps)

    def pose_of_depth(self, topics: SensorTopics) -> Pose | None:
        """Return the pose from the depth camera into the colour camera, None where the recording does not say it."""
        depth, color = self.frames_of(topics)
        return find_pose(self.transforms, source=depth, target=color)

    def frames_of(self, topics: SensorTopics) -> tuple[str, str]:
        """Return the names of the frames of reference of the depth camera and the colour camera."""
        depth, color = self.cameras.get(topics.depth_info), self.cameras.get(topics.color_info)
        return (
            (depth and depth.frame_id) or self.frame_ids.get(topics.depth, ""),
            (color and color.frame_id) or self.frame_ids.get(topics.color, ""),
        )


def survey(container: Container, named: Mapping[str, SensorTopics], only: Collection[str]) -> Survey:
    """Read until every sensor is known, or to the end where one stays incomplete.

    Args:
        container: the recording.
        named: topics that a person named, by sensor.
        only: ids of the sensors that are wanted; empty for all.
    """
    seen = Survey(dict(container.topics or {}))
    looked_bytes, check_at, began_ns = 0, _CHECK_BYTES, None
    for message in container.messages(lambda _topic: True):
        seen.types.setdefault(message.topic, message.type_name)
        began_ns = message.log_time_ns if began_ns is None else began_ns
        looked_bytes += len(message.data)
        _note(seen, message)
        if looked_bytes < check_at:
            continue
        check_at = looked_bytes + _CHECK_BYTES
        looked_enough = message.log_time_ns - began_ns > _LOOK_NS or looked_bytes > _LOOK_BYTES
        if (container.topics or looked_enough) and _complete(seen, named, only):
            break
    return seen


def _note(seen: Survey, message: RawMessage) -> None:
    """Take from a message what is not known yet."""
    try:
        if message.type_name in PICTURE_TYPES:
            _note_picture(seen, message.topic, read_picture(message))
        elif message.type_name == CAMERA_INFO_TYPE and message.topic not in seen.cameras:
            seen.cameras[message.topic] = read_camera_info(message)
        elif message.type_name == TRANSFORMS_TYPE and message.topic in TRANSFORMS_TOPICS:
            seen.transforms += read_transforms(message)
    except MalformedError as error:
        seen.faults[message.topic] = str(error)


def _note_picture(seen: Survey, topic: str, picture: Picture) -> None:
    stamps = seen.stamps_ns.setdefault(topic, [])
    if len(stamps) < _ENOUGH_STAMPS:
        seen.sizes_met.setdefault(topic, Counter())[picture_size(picture)] += 1
        seen.frame_ids.setdefault(topic, picture.frame_id)
        stamps.append(picture.stamp_ns)


def _complete(seen: Survey, named: Mapping[str, SensorTopics], only: Collection[str]) -> bool:
    sensors = find_sensors(seen.types, named)
    wanted = [topics for sensor, topics in sensors.items() if not only or sensor in only]
    return bool(wanted) and all(_sensor_complete(seen, topics) for topics in wanted)


def _sensor_complete(seen: Survey, topics: SensorTopics) -> bool:
    if not (topics.color and topics.depth):
        return True
    pictures = topics.color in seen.sizes_met and len(seen.stamps_ns.get(topics.depth, ())) >= _ENOUGH_STAMPS
    cameras = topics.color_info in seen.cameras and (not topics.depth_info or topics.depth_info in seen.cameras)
    return pictures and cameras and (not topics.depth_info or seen.pose_of_depth(topics) is not None)
