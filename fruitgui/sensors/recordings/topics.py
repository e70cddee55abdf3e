"""Which topics of a recording make up which sensor."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

from fruitgui.errors import InputError

PICTURE_TYPES = frozenset({"sensor_msgs/Image", "sensor_msgs/CompressedImage"})
CAMERA_INFO_TYPE = "sensor_msgs/CameraInfo"
TRANSFORMS_TYPE = "tf2_msgs/TFMessage"
TRANSFORMS_TOPICS = frozenset({"/tf_static"})

_WORDS_FOR_REGISTERED = ("registered", "aligned")
_PACKINGS = ("", "/compressed", "/compressedDepth")
_OWN_TOPIC = re.compile(r"/([^/]+)/(rgb|depth|depth_registered)/(image_raw|camera_info)(/compressed(?:Depth)?)?")
_SENSOR_ID = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_PARTS = {"rgb": "color", "color": "color", "info": "color_info", "depth": "depth", "depth_info": "depth_info"}


@dataclass(frozen=True, slots=True)
class SensorTopics:
    """The topics of one sensor; empty where there is none.

    Attributes:
        color, color_info: pictures of the colour camera, and its intrinsics.
        depth: pictures of depth.
        depth_info: intrinsics of the depth camera where depth is in a camera of its own; empty where
            depth is registered to colour already.
    """

    color: str = ""
    color_info: str = ""
    depth: str = ""
    depth_info: str = ""

    @property
    def all(self) -> tuple[str, ...]:
        """The topics that are there."""
        return tuple(topic for topic in (self.color, self.color_info, self.depth, self.depth_info) if topic)


def parse_topics(options: Iterable[str]) -> dict[str, SensorTopics]:
    """Read `--topics S:rgb=/…,info=/…,depth=/…[,depth_info=/…]` options.

    Parts that are left out keep the names of the product's own recordings; the
    camera_info of a picture is looked for beside it. Depth is in a camera of its
    own if `depth_info` is given, or if a camera_info other than the colour
    camera's stands beside it.

    Raises:
        InputError: an option that cannot be understood.
    """
    named: dict[str, SensorTopics] = {}
    for option in options:
        sensor, colon, rest = option.partition(":")
        if not colon or not _SENSOR_ID.fullmatch(sensor):
            raise _bad_option(option, "it does not begin with a sensor's id and a colon")
        if sensor in named:
            raise _bad_option(option, f"sensor {sensor} is named twice")
        named[sensor] = _parts(option, rest)
    return named


def _parts(option: str, rest: str) -> SensorTopics:
    topics = SensorTopics()
    for part in rest.split(","):
        key, equals, topic = (piece.strip() for piece in part.partition("="))
        if not equals or key not in _PARTS:
            raise _bad_option(option, f"{part!r} is none of rgb=, info=, depth=, depth_info=")
        if not topic.startswith("/") or len(topic) < 2:
            raise _bad_option(option, f"the topic {topic!r} does not begin with /")
        if getattr(topics, _PARTS[key]):
            raise _bad_option(option, f"{key} is given twice")
        topics = replace(topics, **{_PARTS[key]: topic})
    return topics


def _bad_option(option: str, why: str) -> InputError:
    return InputError(
        "bad_topics",
        f"--topics {option}: {why}.",
        "Write it like kinect_1:rgb=/camera/rgb/image_raw,info=/camera/rgb/camera_info,depth=/camera/depth/image_raw.",
        where="--topics",
    )


def find_sensors(types: Mapping[str, str], named: Mapping[str, SensorTopics]) -> dict[str, SensorTopics]:
    """Return the sensors of a recording, by id: whatever has a topic with pictures.

    Args:
        types: type name by topic, of the whole recording or of what is known of it so far.
        named: topics that a person named; they go before the names of the product's own recordings.
    """
    found: dict[str, SensorTopics] = {}
    for topic, kind in types.items():
        match = _OWN_TOPIC.fullmatch(topic) if kind in PICTURE_TYPES else None
        if match and match[1] not in found:
            found[match[1]] = _own_names(match[1], types)
    for sensor, topics in named.items():
        found[sensor] = _with_names(topics, found.get(sensor, SensorTopics()), types)
    return found


def sensor_of(topic: str) -> str | None:
    """Return the sensor whose pictures a topic of the product's own names holds, None for any other topic."""
    match = _OWN_TOPIC.fullmatch(topic)
    return match[1] if match and match[3] == "image_raw" else None


def _own_names(sensor: str, types: Mapping[str, str]) -> SensorTopics:
    color = _recorded(f"/{sensor}/rgb/image_raw", types)
    color_info = f"/{sensor}/rgb/camera_info"
    registered = _recorded(f"/{sensor}/depth_registered/image_raw", types)
    if registered:
        return SensorTopics(color, color_info, registered)
    depth = _recorded(f"/{sensor}/depth/image_raw", types)
    return SensorTopics(color, color_info, depth, f"/{sensor}/depth/camera_info" if depth else "")


def _with_names(named: SensorTopics, own: SensorTopics, types: Mapping[str, str]) -> SensorTopics:
    color = _recorded(named.color, types) or named.color or own.color
    depth = _recorded(named.depth, types) or named.depth
    color_info = named.color_info or (_beside(named.color) if named.color else own.color_info)
    if not depth:
        return SensorTopics(color, color_info, own.depth, named.depth_info or own.depth_info)
    return SensorTopics(color, color_info, depth, named.depth_info or _info_of_depth(depth, color_info, types))


def _info_of_depth(depth: str, color_info: str, types: Mapping[str, str]) -> str:
    """Return the camera_info beside a depth topic that a person named; empty where it has none of its own."""
    info = _beside(depth)
    registered = any(word in depth for word in _WORDS_FOR_REGISTERED)
    return info if types.get(info) == CAMERA_INFO_TYPE and info != color_info and not registered else ""


def _beside(topic: str) -> str:
    """Return the camera_info that stands beside a picture's topic."""
    for packing in _PACKINGS[1:]:
        topic = topic.removesuffix(packing)
    return topic.rpartition("/")[0] + "/camera_info"


def _recorded(base: str, types: Mapping[str, str]) -> str:
    """Return the topic that holds the pictures of `base`, raw before packed; empty where none does."""
    return next((base + packing for packing in _PACKINGS if types.get(base + packing) in PICTURE_TYPES), "")
