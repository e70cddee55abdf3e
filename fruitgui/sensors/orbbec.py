"""Orbbec depth cameras, through pyorbbecsdk2 (Orbbec SDK 2). Written after its documentation, not tried on a device."""

from __future__ import annotations

import logging
from collections.abc import Sequence

import numpy as np

from fruitgui.frame import Intrinsics
from fruitgui.geometry.pose import Pose
from fruitgui.sensors.drivers import PluggedDevice
from fruitgui.sensors.registration import Registration
from fruitgui.sensors.sdk import RATE_HZ, Opened, Sdk, SdkDriver, Shot, gone
from fruitgui.sensors.sensor import Projector

log = logging.getLogger(__name__)


class OrbbecCamera:
    """One Orbbec in the SDK's hands."""

    def __init__(self, ob: Sdk, serial: str) -> None:
        self._ob, self._serial = ob, serial
        self._context = ob.Context()
        self._pipeline: Sdk = None
        self._device: Sdk = None

    def start(self) -> Opened:
        """Take the device and begin to stream."""
        ob = self._ob
        self._device = self._context.query_devices().get_device_by_serial_number(self._serial)
        pipeline, config = ob.Pipeline(self._device), ob.Config()
        color = _profile(pipeline.get_stream_profile_list(ob.OBSensorType.COLOR_SENSOR), ob.OBFormat.RGB, 640, 480)
        depth = _profile(pipeline.get_stream_profile_list(ob.OBSensorType.DEPTH_SENSOR), ob.OBFormat.Y16, 640, 0)
        for one in (color, depth):
            config.enable_stream(one)
        config.set_frame_aggregate_output_mode(ob.OBFrameAggregateOutputMode.FULL_FRAME_REQUIRE)
        pipeline.enable_frame_sync()
        pipeline.start(config)
        self._pipeline = pipeline
        placed = depth.get_extrinsic_to(color)
        pose = Pose(np.array(placed.rot, dtype=np.float64).reshape(3, 3), np.ravel(placed.transform) * 1e-3)
        says = self._device.get_device_info()
        registration = Registration(depth=_camera(depth), color=_camera(color), pose=pose)
        return Opened(str(says.get_name()), registration.color, registration, str(says.get_firmware_version()))

    def next(self, timeout_s: float) -> Shot | None:
        """Return the next capture; None where none comes in time. Raises `WorldError` where the device is gone."""
        frames = self._pipeline.wait_for_frames(max(int(timeout_s * 1e3), 1))
        depth, color = (None, None) if frames is None else (frames.get_depth_frame(), frames.get_color_frame())
        if depth is None or color is None:
            if self._serial not in {one.serial for one in listed_devices(self._ob)}:
                raise gone("Orbbec", self._serial)
            return None
        pixels = np.frombuffer(depth.get_data(), np.uint16).reshape(depth.get_height(), depth.get_width())
        rgb = np.frombuffer(color.get_data(), np.uint8).reshape(color.get_height(), color.get_width(), 3)
        mm = float(depth.get_depth_scale())
        depth_mm = pixels if mm == 1.0 else np.rint(pixels * mm).astype(np.uint16)
        return Shot(depth.get_index(), depth.get_timestamp_us() * 1e-6, rgb, depth_mm)

    def lock_color(self, on: bool) -> bool:
        """Hold exposure and white balance, or let them follow the light."""
        properties = self._ob.OBPropertyID
        for one in (properties.OB_PROP_COLOR_AUTO_EXPOSURE_BOOL, properties.OB_PROP_COLOR_AUTO_WHITE_BALANCE_BOOL):
            self._device.set_bool_property(one, not on)
        return True

    def stop(self) -> None:
        """End streaming."""
        pipeline, self._pipeline = self._pipeline, None
        if pipeline is not None:
            pipeline.stop()


def listed_devices(ob: Sdk) -> Sequence[PluggedDevice]:
    """Return the devices that the SDK lists."""
    devices = ob.Context().query_devices()
    return [
        PluggedDevice(
            "orbbec", devices.get_device_name_by_index(one), devices.get_device_serial_number_by_index(one)
        )
        for one in range(devices.get_count())
    ]  # fmt: skip


def _profile(profiles: Sdk, form: Sdk, width: int, height: int) -> Sdk:
    """Return the stream of a size, or the one that the device likes best; height 0 is any."""
    try:
        return profiles.get_video_stream_profile(width, height, form, int(RATE_HZ))
    except Exception as error:  # noqa: BLE001 - the SDK's own error, an `Exception`: the model has no such stream
        log.info("no stream %s by %s of %s: %s; its own choice instead", width, height, form, error)
        return profiles.get_default_video_stream_profile()


def _camera(profile: Sdk) -> Intrinsics:
    told, lens = profile.get_intrinsic(), profile.get_distortion()
    bent = (lens.k1, lens.k2, lens.p1, lens.p2, lens.k3, lens.k4, lens.k5, lens.k6)
    return Intrinsics(told.width, told.height, told.fx, told.fy, told.cx, told.cy, bent if any(bent) else ())


ORBBEC = SdkDriver(
    "orbbec",
    "Orbbec",
    "pyorbbecsdk",
    "pip install --no-deps pyorbbecsdk2",
    listed_devices,
    OrbbecCamera,
    Projector.FIXED,  # the SDK does not tell stereo models (harmless) from those of structured light (not)
)
