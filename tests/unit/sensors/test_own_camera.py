"""Recordings whose depth is in a camera of its own."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fruitgui.errors import InputError
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rotation import rotation_from_vector
from fruitgui.sensors.recordings import open_recording, parse_topics
from fruitgui.sensors.recordings.transforms import find_pose
from fruitgui.sensors.recordings.wire import Transform
from fruitgui.sensors.registration import Registration
from tests.unit.sensors import ros_files as ros

NONE = (0.0, 0.0, 0.0, 1.0)
DEPTH_K = np.array([70.0, 0, 30.0, 0, 70.0, 24.0, 0, 0, 1.0])


def story(
    *transforms: ros.Message, color: str = "/k1/rgb", depth: str = "/k1/depth", image: str = "image_raw"
) -> list[ros.Message]:
    messages = list(transforms)
    for n in range(4):
        t = 1.0 + n / 10
        messages += [
            ros.camera_info(f"{color}/camera_info", t, frame_id="color"),
            ros.camera_info(f"{depth}/camera_info", t, frame_id="/depth", k=DEPTH_K, d=np.array([0.05, 0, 0, 0, 0])),
            ros.image(f"{color}/{image}", t, "rgb8", ros.colored(t)),
            ros.image(f"{depth}/{image}", t, "16UC1", ros.depth(t)),
        ]
    return messages


def registration(path: Path, **options: object) -> Registration:
    recording = open_recording(path, **options)  # type: ignore[arg-type]
    found = recording._decoders["k1"].registration
    assert found is not None
    read = [frame for _, frame in recording.frames()]
    assert len(read) == 4
    for frame in read:
        np.testing.assert_array_equal(frame.depth_mm, found.apply(ros.depth(frame.time_s)))
        assert (frame.depth_mm > 0).mean() > 0.4
    return found


def test_the_transform_may_be_given_through_a_chain_in_either_direction(tmp_path: Path) -> None:
    direct = ros.transforms(("color", "depth", (0.025, 0.001, -0.002), NONE))
    backward = ros.transforms(("depth", "color", (-0.025, -0.001, 0.002), NONE))
    chain = [
        ros.transforms(("base", "color_link", (0.5, 0.0, 0.0), NONE), ("color_link", "color", (0.0, 0.1, 0.0), NONE)),
        ros.transforms(("elsewhere", "else", (9, 9, 9), NONE)),
        ros.transforms(("base", "depth_link", (0.525, 0.101, 0.0), NONE)),
        ros.transforms(("depth_link", "depth", (0.0, 0.0, -0.002), NONE)),
    ]
    for n, transforms in enumerate(([direct], [backward], chain)):
        found = registration(ros.write_mcap(tmp_path / f"{n}.mcap", story(*transforms)))
        np.testing.assert_allclose(found.pose.matrix[:3, 3], (0.025, 0.001, -0.002), atol=1e-12)
        np.testing.assert_allclose(found.pose.rotation, np.eye(3), atol=1e-12)
        assert found.depth.fx == 70.0
        assert found.depth.distortion == (0.05, 0, 0, 0, 0)


def test_a_bag_has_it_too(tmp_path: Path) -> None:
    edge = ros.transforms(("color", "depth", (0.025, 0.0, 0.0), NONE))
    assert registration(ros.write_bag(tmp_path / "r.bag", story(edge))).pose.translation_m[0] == 0.025


def test_a_transform_that_comes_last_is_found(tmp_path: Path) -> None:
    edge = ros.transforms(("color", "depth", (0.025, 0.0, 0.0), NONE))
    path = ros.write_mcap(tmp_path / "r.mcap", [*story(), edge])
    assert registration(path).pose.translation_m[0] == 0.025


def test_other_names_with_a_camera_beside_the_depth(tmp_path: Path) -> None:
    edge = ros.transforms(("color", "depth", (0.025, 0.0, 0.0), NONE))
    path = ros.write_mcap(tmp_path / "r.mcap", story(edge, color="/cam/color", depth="/cam/stereo", image="image_rect"))
    topics = parse_topics(["k1:rgb=/cam/color/image_rect,depth=/cam/stereo/image_rect"])
    found = registration(path, topics=topics)
    assert found.depth.distortion == (), "a rectified picture has no lens"
    option = "k1:rgb=/cam/color/image_rect,depth=/cam/stereo/image_rect,depth_info=/cam/stereo/camera_info"
    named = parse_topics([option])
    assert registration(path, topics=named).pose.translation_m[0] == 0.025


@pytest.mark.parametrize(
    "transforms",
    [
        [],
        [ros.transforms(("color", "other", (0, 0, 0), NONE))],
        [ros.transforms(("color", "depth", (np.nan, 0, 0), NONE))],
        [ros.transforms(("color", "depth", (0, 0, 0), (0, 0, 0, 0)))],
    ],
)
def test_without_the_transform_it_says_so(tmp_path: Path, transforms: list[ros.Message]) -> None:
    with pytest.raises(InputError, match=r"/tf_static.*'color'") as caught:
        open_recording(ros.write_mcap(tmp_path / "r.mcap", story(*transforms)))
    assert caught.value.where == "/tf_static"


def test_registered_depth_goes_before_depth_of_its_own_camera(tmp_path: Path) -> None:
    messages = story()
    for n in range(4):
        t = 1.0 + n / 10
        messages.append(ros.image("/k1/depth_registered/image_raw", t, "16UC1", ros.depth(t)))
    path = ros.write_mcap(tmp_path / "r.mcap", sorted(messages, key=lambda message: message.log_s))
    np.testing.assert_array_equal(next(open_recording(path).frames())[1].depth_mm, ros.depth(1.0))


@given(turn=st.tuples(*[st.floats(-3, 3)] * 3), shift=st.tuples(*[st.floats(-5, 5)] * 3), scale=st.floats(0.6, 1.9))
def test_a_quaternion_of_any_length_is_its_rotation(
    turn: tuple[float, float, float], shift: tuple[float, float, float], scale: float
) -> None:
    angle = float(np.linalg.norm(turn))
    axis = np.array(turn) / (angle or 1.0)
    x, y, z = scale * np.sin(angle / 2) * axis
    edge = Transform("color", "depth", shift, (x, y, z, scale * np.cos(angle / 2)))
    there, back = find_pose([edge], source="depth", target="color"), find_pose([edge], source="color", target="depth")
    assert there is not None
    assert back is not None
    np.testing.assert_allclose(there.rotation, rotation_from_vector(np.array(turn)), atol=1e-9)
    np.testing.assert_allclose((there @ back).matrix, np.eye(4), atol=1e-9)


def test_loops_and_long_chains_end() -> None:
    ring = [Transform(str(n), str((n + 1) % 500), (0.0, 0.0, 0.0), NONE) for n in range(500)]
    pose = find_pose(ring, source="250", target="0")
    assert pose is not None
    np.testing.assert_allclose(pose.matrix, Pose().matrix)
    assert find_pose(ring, source="250", target="nowhere") is None
