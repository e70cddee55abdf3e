"""Luxonis OAK-D, through depthai 3. Written after its documentation, not tried on a device."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import timedelta

import numpy as np

from fruitgui.frame import Intrinsics
from fruitgui.sensors.drivers import PluggedDevice
from fruitgui.sensors.sdk import RATE_HZ, Opened, Sdk, SdkDriver, Shot, gone
from fruitgui.sensors.sensor import Projector

WIDTH, HEIGHT = 640, 480


class OakCamera:
    """One OAK in the SDK's hands; the device itself registers depth to the undistorted colour picture."""

    def __init__(self, dai: Sdk, serial: str) -> None:
        self._dai, self._serial = dai, serial
        self._device: Sdk = None
        self._pipeline: Sdk = None
        self._queue: Sdk = None
        self._control: Sdk = None

    def start(self) -> Opened:
        """Take the device and begin to stream."""
        dai = self._dai
        self._device = dai.Device(dai.DeviceInfo(self._serial))
        pipeline = self._pipeline = dai.Pipeline(self._device)
        sockets = dai.CameraBoardSocket
        camera = pipeline.create(dai.node.Camera).build(sockets.CAM_A)
        color = camera.requestOutput(
            (WIDTH, HEIGHT), dai.ImgFrame.Type.RGB888i, fps=RATE_HZ, enableUndistortion=True
        )  # fmt: skip
        left, right = (
            pipeline.create(dai.node.Camera).build(one).requestOutput((640, 400), fps=RATE_HZ)
            for one in (sockets.CAM_B, sockets.CAM_C)
        )
        stereo = pipeline.create(dai.node.StereoDepth).build(left, right)
        stereo.setDepthAlign(sockets.CAM_A)
        stereo.setOutputSize(WIDTH, HEIGHT)
        together = pipeline.create(dai.node.Sync)
        together.setSyncThreshold(timedelta(seconds=0.5 / RATE_HZ))
        color.link(together.inputs["color"])
        stereo.depth.link(together.inputs["depth"])
        self._queue = together.out.createOutputQueue(maxSize=4, blocking=False)
        self._control = camera.inputControl.createInputQueue()
        pipeline.start()
        K = self._device.readCalibration().getCameraIntrinsics(sockets.CAM_A, WIDTH, HEIGHT)
        return Opened(str(self._device.getDeviceName() or "OAK"),
                      Intrinsics(WIDTH, HEIGHT, K[0][0], K[1][1], K[0][2], K[1][2]))  # fmt: skip

    def next(self, timeout_s: float) -> Shot | None:
        """Return the next capture; None where none comes in time. Raises `WorldError` where the device is gone."""
        if self._device.isClosed():
            raise gone("OAK", self._serial)
        group = self._queue.get(timedelta(seconds=timeout_s))
        if group is None:
            return None
        color, depth = group["color"], group["depth"]
        depth_mm = np.asarray(depth.getFrame(), dtype=np.uint16)
        device_s = depth.getTimestampDevice().total_seconds()
        return Shot(depth.getSequenceNum(), device_s, np.asarray(color.getFrame()), depth_mm)

    def lock_color(self, on: bool) -> bool:
        """Hold exposure and white balance, or let them follow the light."""
        control = self._dai.CameraControl()
        control.setAutoExposureLock(on)
        control.setAutoWhiteBalanceLock(on)
        self._control.send(control)
        return True

    def stop(self) -> None:
        """End streaming."""
        pipeline, self._pipeline = self._pipeline, None
        device, self._device = self._device, None
        if pipeline is not None:
            pipeline.stop()
        if device is not None:
            device.close()


def listed_devices(dai: Sdk) -> Sequence[PluggedDevice]:
    """Return the devices that the SDK lists, used or not."""
    return [PluggedDevice("oak", "OAK", one.getDeviceId()) for one in dai.Device.getAllConnectedDevices()]


OAK = SdkDriver(
    "oak", "Luxonis", "depthai", 'pip install "fruitgui[oak]"', listed_devices, OakCamera, Projector.HARMLESS
)
