"""A RealSense that plays a file, which the SDK's own software device recorded; in a process of its own.

`python -m tests.unit.sensors.realsense_file CHECK FOLDER` runs one of the checks below.
"""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pyrealsense2 as rs
import pytest

from fruitgui.errors import WorldError
from fruitgui.frame import U8, U16, Frame, Intrinsics
from fruitgui.geometry.pose import Pose
from fruitgui.sensors.realsense import REALSENSE, RealSenseCamera
from fruitgui.sensors.registration import Registration
from fruitgui.sensors.sdk import Sdk, SdkSensor
from fruitgui.sensors.sensor import Projector, SensorTimeoutError
from tests.unit.sensors.contract import check_is_refused, check_waits, walk

SERIAL = "923322071108"
WIDTH, HEIGHT, RATE_HZ = 640, 480, 30
COLOR = (WIDTH, HEIGHT, 615.0, 615.0, 320.5, 238.0)
DEPTH = (WIDTH, HEIGHT, 386.0, 386.0, 319.5, 239.5)
TURN = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
"""A quarter turn about the axis: rotations that are read row by row instead of column by column go the other way."""


@dataclass(frozen=True)
class Made:
    """What is recorded.

    Attributes:
        frames: colour and depth as the device counts them. units_m: of depth. depth: camera. pose: depth in colour.
        lens: of the colour camera, told from the picture to the ray.
    """

    frames: list[tuple[U8, U16]]
    units_m: float = 0.001
    depth: tuple[float, ...] = COLOR
    pose: Pose = field(default_factory=Pose)
    lens: tuple[float, ...] = (0.0,) * 5


def pictures(count: int = 30) -> list[tuple[U8, U16]]:
    """Return pictures that differ in every pixel and from each other."""
    rng = np.random.default_rng(7)
    return [
        (
            rng.integers(0, 256, (HEIGHT, WIDTH, 3), dtype=np.uint8),
            rng.integers(500, 1500, (HEIGHT, WIDTH)).astype(np.uint16),
        )
        for _ in range(count)
    ]


def record(path: Path, made: Made) -> None:
    """Let the SDK's software device record a file."""
    device = rs.software_device()
    device.register_info(rs.camera_info.name, "Intel RealSense D435")
    device.register_info(rs.camera_info.serial_number, SERIAL)
    sensors = [device.add_sensor(name) for name in ("Stereo Module", "RGB Camera")]
    none = [0.0] * 5
    depth = sensors[0].add_video_stream(
        _stream(0, rs.stream.depth, rs.format.z16, 2, made.depth, rs.distortion.brown_conrady, none)
    )
    color = sensors[1].add_video_stream(
        _stream(1, rs.stream.color, rs.format.rgb8, 3, COLOR, rs.distortion.inverse_brown_conrady, list(made.lens))
    )
    placed = rs.extrinsics()
    placed.rotation = made.pose.rotation.T.ravel().tolist()
    placed.translation = made.pose.translation_m.tolist()
    depth.register_extrinsics_to(color, placed)
    sensors[0].add_read_only_option(rs.option.depth_units, made.units_m)
    recorder = rs.recorder(str(path), device)
    syncer = rs.syncer()
    for sensor, profile in zip(sensors, (depth, color), strict=True):
        sensor.open(profile)
        sensor.start(syncer)
    for number, (rgb, z) in enumerate(made.frames):
        sensors[0].on_video_frame(_frame(depth, z, number, made.units_m))
        sensors[1].on_video_frame(_frame(color, rgb, number, 0.0))
        syncer.wait_for_frames()
    for sensor in sensors:
        sensor.stop()
        sensor.close()
    del recorder


def _stream(uid: int, kind: Sdk, form: Sdk, size: int, camera: tuple[float, ...], model: Sdk, lens: list[float]) -> Sdk:
    intrinsics = rs.intrinsics()
    intrinsics.width, intrinsics.height = WIDTH, HEIGHT
    intrinsics.fx, intrinsics.fy, intrinsics.ppx, intrinsics.ppy = camera[2:]
    intrinsics.model, intrinsics.coeffs = model, lens
    stream = rs.video_stream()
    stream.type, stream.index, stream.uid, stream.fmt, stream.bpp = kind, 0, uid, form, size
    stream.width, stream.height, stream.fps, stream.intrinsics = WIDTH, HEIGHT, RATE_HZ, intrinsics
    return stream


def _frame(profile: Sdk, pixels: Sdk, number: int, units_m: float) -> Sdk:
    frame = rs.software_video_frame()
    frame.pixels = np.ascontiguousarray(pixels)
    frame.bpp = pixels.strides[1]
    frame.stride = pixels.strides[0]
    frame.timestamp = 5000.0 + number * 1000.0 / RATE_HZ
    frame.domain = rs.timestamp_domain.hardware_clock
    frame.frame_number = number
    frame.profile = profile.as_video_stream_profile()
    if units_m:
        frame.depth_units = units_m
    return frame


def every_picture_of(path: Path) -> Callable[[Sdk], None]:
    """Return what lets a pipeline play a file, every picture of it, as fast as it is read."""

    def choose(config: Sdk) -> None:
        rs.config.enable_device_from_file(config, str(path), False)
        profile = config.resolve(rs.pipeline_wrapper(rs.pipeline()))
        profile.get_device().as_playback().set_real_time(False)

    return choose


class OwnClock:
    """Leaves a file's times as they are."""

    jumps, sure = 0, True

    def time_s(self, device_s: float, arrived_s: float) -> float:  # noqa: ARG002 - nothing arrives
        return device_s


def played(path: Path) -> SdkSensor:
    return SdkSensor(
        "realsense",
        "Intel",
        SERIAL,
        lambda: RealSenseCamera(rs, SERIAL, every_picture_of(path)),
        Projector.HARMLESS,
        OwnClock,
    )


def frames_of(sensor: SdkSensor) -> list[Frame]:
    """Return all frames of a file."""
    sensor.open()
    sensor.start()
    frames = []
    try:
        while True:
            frames.append(sensor.read(8.0))
    except SensorTimeoutError:
        return frames
    finally:
        sensor.close()


def check_contract(path: Path) -> None:
    record(path, Made(pictures(40)))
    walk(played(path))
    sensor = played(path)
    sensor.open()
    sensor.start()
    with contextlib.suppress(SensorTimeoutError):  # where a file ends, the SDK gives nothing more
        for _ in range(41):
            sensor.read(8.0)
    check_waits(sensor)
    sensor.close()


def check_bit_exact(path: Path) -> None:
    made = pictures()
    record(path, Made(made))
    sensor = played(path)
    frames = frames_of(sensor)
    assert len(frames) >= len(made) // 3  # on a busy machine the SDK's recorder leaves some out
    for frame in frames:
        number = round((frame.time_s - 5.0) * RATE_HZ)
        color, depth_mm = made[number]
        assert (frame.depth_mm == depth_mm).all()
        assert (frame.color == color).all()
    assert sensor.info.model == "Intel RealSense D435"
    assert sensor.info.serial == SERIAL
    assert sensor.info.intrinsics == Intrinsics(*COLOR)


def check_units(path: Path) -> None:
    made = [(color, (depth_mm * 10).astype(np.uint16)) for color, depth_mm in pictures(6)]
    record(path, Made(made, units_m=0.0001))
    for frame in frames_of(played(path)):
        number = round((frame.time_s - 5.0) * RATE_HZ)
        assert (frame.depth_mm == made[number][1] // 10).all()


def check_registration(path: Path) -> None:
    """A wall with a lower left quarter that stands out is seen where the geometry says."""
    z = np.full((HEIGHT, WIDTH), 1200, np.uint16)
    z[240:, :320] = 800
    pose = Pose(TURN, np.array([0.015, -0.02, 0.0]))
    lens = (0.08, -0.15, 0.001, -0.0005, 0.04)
    record(path, Made([(color, z) for color, _ in pictures(6)], depth=DEPTH, pose=pose, lens=lens))
    sensor = played(path)
    frame = frames_of(sensor)[0]
    camera = sensor.info.intrinsics
    assert (frame.depth_mm == Registration(Intrinsics(*DEPTH), camera, pose).apply(z)).all()
    seen_inside = 0
    for u, v in ((150, 300), (300, 300), (400, 300), (250, 150), (420, 200)):
        depth_m = z[v, u] * 1e-3
        seen = pose.apply([(u - DEPTH[4]) / DEPTH[2] * depth_m, (v - DEPTH[5]) / DEPTH[3] * depth_m, depth_m])
        pixel = camera.project(seen[None])[0]
        if not (5 <= pixel[0] < WIDTH - 5 and 5 <= pixel[1] < HEIGHT - 5):
            continue
        seen_inside += 1
        told = _stream(1, rs.stream.color, rs.format.rgb8, 3, COLOR, rs.distortion.inverse_brown_conrady, list(lens))
        back = rs.rs2_deproject_pixel_to_point(told.intrinsics, pixel.tolist(), float(seen[2]))
        assert np.allclose(back, seen, atol=3e-4)  # half a pixel at this distance is 0.6 mm
        assert abs(int(frame.depth_mm[round(pixel[1]), round(pixel[0])]) - round(seen[2] * 1e3)) <= 1
    assert seen_inside >= 3


def check_absent(path: Path) -> None:  # noqa: ARG001
    """Without a device nothing is listed, and opening by serial says what is missing."""
    assert REALSENSE.problem() is None
    assert not REALSENSE.devices()
    sensor = REALSENSE.sensor(SERIAL)
    check_is_refused(sensor)
    with pytest.raises(WorldError) as told:
        sensor.open()
    assert SERIAL in told.value.what
    sensor.close()


CHECKS: dict[str, Callable[[Path], None]] = {
    "contract": check_contract,
    "bit_exact": check_bit_exact,
    "units": check_units,
    "registration": check_registration,
    "absent": check_absent,
}

if __name__ == "__main__":
    CHECKS[sys.argv[1]](Path(sys.argv[2]) / "recorded.db3")
