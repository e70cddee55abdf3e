"""Intel RealSense, through pyrealsense2 (librealsense 2).

Depth is registered here, not by the SDK's `align`, which draws readings as points and so
shrinks what is near (see `registration.py`).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from fruitgui.frame import Intrinsics
from fruitgui.geometry.pose import Pose
from fruitgui.sensors.drivers import PluggedDevice
from fruitgui.sensors.registration import Registration
from fruitgui.sensors.sdk import RATE_HZ, Opened, Sdk, SdkDriver, Shot, gone
from fruitgui.sensors.sensor import Projector

_USB_2 = "On a USB 2 port it gives fewer and smaller pictures: plug it into a USB 3 port with a USB 3 cable."


class RealSenseCamera:
    """One RealSense in the SDK's hands.

    Args:
        rs: the SDK.
        serial: of the device.
        choose: tells a pipeline's configuration which device is meant; by serial unless given.
    """

    def __init__(self, rs: Sdk, serial: str, choose: Callable[[Sdk], None] | None = None) -> None:
        self._rs, self._serial = rs, serial
        self._choose = choose or (lambda config: config.enable_device(serial))
        self._pipeline: Sdk = None
        self._device: Sdk = None

    def start(self) -> Opened:
        """Take the device and begin to stream."""
        rs = self._rs
        config, pipeline = rs.config(), rs.pipeline()
        self._choose(config)
        config.enable_stream(rs.stream.depth, 640, 480, rs.format.z16, int(RATE_HZ))
        config.enable_stream(rs.stream.color, 640, 480, rs.format.rgb8, int(RATE_HZ))
        profile = pipeline.start(config)
        self._pipeline, self._device = pipeline, profile.get_device()
        depth, color = (profile.get_stream(one).as_video_stream_profile() for one in (rs.stream.depth, rs.stream.color))
        depth_camera, color_camera = (_camera(one.get_intrinsics()) for one in (depth, color))
        pose = _pose(depth.get_extrinsics_to(color))
        same = depth_camera == color_camera and np.allclose(pose.translation_m, 0.0)
        name = self._device.get_info(rs.camera_info.name)
        registration = None if same else Registration(depth_camera, color_camera, pose)
        return Opened(name, color_camera, registration, _told(self._device, rs.camera_info.firmware_version))

    def next(self, timeout_s: float) -> Shot | None:
        """Return the next capture; None where none comes in time. Raises `WorldError` where the device is gone."""
        came, frames = self._pipeline.try_wait_for_frames(max(int(timeout_s * 1e3), 1))
        depth, color = (frames.get_depth_frame(), frames.get_color_frame()) if came else (None, None)
        if not came and not self._device.is_playback() and self._serial not in _serials(self._rs):
            raise gone("RealSense", self._serial)
        if not depth or not color or _apart_s(depth, color) > 0.5 / RATE_HZ:
            return None  # the SDK gives depth with an older colour first, and again with its own
        pixels = np.asanyarray(depth.get_data())
        mm = depth.get_units() * 1e3
        depth_mm = pixels if abs(mm - 1.0) < 1e-6 else np.rint(pixels * mm).astype(np.uint16)
        return Shot(depth.get_frame_number(), depth.get_timestamp() * 1e-3, np.asanyarray(color.get_data()), depth_mm)

    def lock_color(self, on: bool) -> bool:
        """Hold exposure and white balance; a model without such an option keeps its own way."""
        option, sensor = self._rs.option, self._device.first_color_sensor()
        automatic = [one for one in (option.enable_auto_exposure, option.enable_auto_white_balance)
                     if sensor.supports(one)]  # fmt: skip
        for one in automatic:
            sensor.set_option(one, 0.0 if on else 1.0)
        return len(automatic) == 2

    def stop(self) -> None:
        """End streaming."""
        pipeline, self._pipeline = self._pipeline, None
        if pipeline is not None:
            pipeline.stop()


def _apart_s(depth: Sdk, color: Sdk) -> float:
    """Return the time between two pictures; 0 where their clocks differ."""
    if depth.get_frame_timestamp_domain() != color.get_frame_timestamp_domain():
        return 0.0
    return abs(float(depth.get_timestamp() - color.get_timestamp())) * 1e-3


def listed_devices(rs: Sdk) -> Sequence[PluggedDevice]:
    """Return the devices that the SDK lists."""
    return [_plugged(device, rs.camera_info) for device in rs.context().query_devices()]


def _serials(rs: Sdk) -> set[str]:
    return {one.serial for one in listed_devices(rs)}


def _plugged(device: Sdk, info: Sdk) -> PluggedDevice:
    limits = (_USB_2,) if _told(device, info.usb_type_descriptor).startswith("2") else ()
    name = _told(device, info.name).removeprefix("Intel ")
    serial, firmware = _told(device, info.serial_number), _told(device, info.firmware_version)
    return PluggedDevice("realsense", name, serial, firmware, limits)


def _told(device: Sdk, what: Sdk) -> str:
    """Return what a device says of itself; empty where it does not."""
    return str(device.get_info(what)) if device.supports(what) else ""


def _camera(told: Sdk) -> Intrinsics:
    """Return a camera; what the SDK calls inverse Brown-Conrady, too, it projects as OpenCV's model (to 0.01 px)."""
    lens = tuple(float(one) for one in told.coeffs) if any(told.coeffs) else ()
    return Intrinsics(told.width, told.height, told.fx, told.fy, told.ppx, told.ppy, lens)


def _pose(told: Sdk) -> Pose:
    """Return the pose of depth in colour; librealsense gives rotations column by column."""
    return Pose(np.array(told.rotation, dtype=np.float64).reshape(3, 3).T, np.array(told.translation, dtype=np.float64))


REALSENSE = SdkDriver(
    "realsense",
    "Intel",
    "pyrealsense2",
    'pip install "fruitgui[realsense]"',
    listed_devices,
    RealSenseCamera,
    Projector.HARMLESS,  # stereo: more dots on the belt are as good
)
