"""Sensors behind a maker's SDK: what is the same for all makes, and two of them on SDKs that only look like theirs."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from datetime import timedelta
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import numpy as np
import pytest

from fruitgui.errors import WorldError
from fruitgui.frame import Intrinsics
from fruitgui.sensors.drivers import PluggedDevice, known_drivers
from fruitgui.sensors.oak import OakCamera
from fruitgui.sensors.oak import listed_devices as listed_oaks
from fruitgui.sensors.orbbec import OrbbecCamera
from fruitgui.sensors.orbbec import listed_devices as listed_orbbecs
from fruitgui.sensors.sdk import Camera, Opened, SdkDriver, SdkSensor, Shot
from fruitgui.sensors.sensor import Projector, SensorTimeoutError
from fruitgui.sensors.usb.machine import Machine
from fruitgui.sensors.usb.plugged import is_plugged
from tests.unit.sensors.contract import walk

HEIGHT, WIDTH = 6, 8
SMALL = Intrinsics(WIDTH, HEIGHT, 10.0, 10.0, 3.5, 2.5)
NUMBERS = range(1, 1000)


def shot(number: int) -> Shot:
    color = np.full((HEIGHT, WIDTH, 3), number % 256, np.uint8)
    return Shot(number, number / 30.0, color, np.full((HEIGHT, WIDTH), 900 + number % 100, np.uint16))


class Scripted:
    """A camera that gives what it is told to; an exception is raised."""

    def __init__(self, shots: Sequence[Shot | Exception | None]) -> None:
        self._all, self._shots = shots, iter(shots)
        self.stopped = 0

    def start(self) -> Opened:
        self._shots = iter(self._all)
        return Opened("Small 1", SMALL)

    def next(self, timeout_s: float) -> Shot | None:  # noqa: ARG002
        given = next(self._shots, None)
        if isinstance(given, Exception):
            raise given
        return given

    def lock_color(self, on: bool) -> bool:
        return on

    def stop(self) -> None:
        self.stopped += 1


def sensor_of(camera: Camera) -> SdkSensor:
    return SdkSensor("small", "Maker", "A 1", lambda: camera, Projector.HARMLESS)


def test_it_keeps_to_the_protocol() -> None:
    walk(sensor_of(Scripted([shot(number) for number in NUMBERS])))


def test_what_the_device_left_out_is_missing_in_the_sequence_and_what_it_repeats_is_not_given_twice() -> None:
    sensor = sensor_of(Scripted([shot(number) for number in (7, 7, 8, 11, 10, 12)]))
    sensor.open()
    sensor.start()
    assert [sensor.read(1.0).sequence for _ in range(4)] == [0, 1, 4, 5]
    with pytest.raises(SensorTimeoutError):
        sensor.read(0.01)


def test_what_an_sdk_raises_is_put_into_words() -> None:
    sensor = sensor_of(Scripted([shot(1), RuntimeError("xioctl(VIDIOC_QBUF) failed")]))
    sensor.open()
    sensor.start()
    sensor.read(1.0)
    with pytest.raises(WorldError, match="VIDIOC_QBUF") as told:
        sensor.read(1.0)
    assert told.value.code == "sensor_failed"
    assert told.value.remedy


def driver_of(module: str, plugged: bool, lists: Callable[[Any], Sequence[PluggedDevice]]) -> SdkDriver:
    return SdkDriver(
        "small",
        "Maker",
        module,
        "pip install small",
        lists,
        lambda _, __: Scripted([]),
        Projector.FIXED,
        lambda _: plugged,
    )


def test_an_sdk_that_is_not_installed_is_named_with_its_remedy_and_nothing_else_happens() -> None:
    driver = driver_of("no_such_sdk", True, lambda _: pytest.fail("listed"))
    missing = driver.problem()
    assert missing is not None
    assert "pip install small" in missing.remedy
    assert driver.devices() == ()
    sensor = driver.sensor("A1")
    with pytest.raises(WorldError) as told:
        sensor.open()
    assert told.value.code == missing.code


@pytest.fixture
def sdk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    (tmp_path / "small_sdk.py").write_text("print('hello from the SDK')\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    return "small_sdk"


def test_an_sdk_is_loaded_once_a_device_is_plugged_in(sdk: str, capsys: pytest.CaptureFixture[str]) -> None:
    def listed(module: ModuleType) -> Sequence[PluggedDevice]:
        return [PluggedDevice("small", module.__name__, "A1")]

    assert driver_of(sdk, False, listed).devices() == ()
    assert sdk not in sys.modules
    driver = driver_of(sdk, True, listed)
    assert driver.devices() == [PluggedDevice("small", sdk, "A1")]
    driver.sensor("A1").open()
    with pytest.raises(WorldError, match="B2") as told:
        driver.sensor("B2").open()
    assert told.value.code == "sensor_gone"
    assert capsys.readouterr().out == ""


def test_an_sdk_that_cannot_list_lists_nothing_and_the_log_says_why(sdk: str, caplog: pytest.LogCaptureFixture) -> None:
    def listed(_: ModuleType) -> Sequence[PluggedDevice]:
        raise RuntimeError("no backend")

    assert driver_of(sdk, True, listed).devices() == ()
    assert "no backend" in caplog.text


def test_what_its_light_does_to_others_is_told(sdk: str) -> None:
    assert driver_of(sdk, True, lambda _: ()).sensor("A1").info.projector is Projector.FIXED


def test_whether_a_make_is_plugged_in_is_seen_in_the_usb_tree(tmp_path: Path) -> None:
    assert not is_plugged("realsense", Machine(tmp_path))
    device = tmp_path / "sys/bus/usb/devices/2-1"
    device.mkdir(parents=True)
    for name, value in (("idVendor", "8086"), ("idProduct", "0b07"), ("devnum", "3")):
        (device / name).write_text(value)
    assert is_plugged("realsense", Machine(tmp_path))
    assert not is_plugged("oak", Machine(tmp_path))


def test_makes_are_known_by_their_words_and_no_sdk_is_loaded_for_it() -> None:
    assert [driver.make for driver in known_drivers()] == ["kinect", "realsense", "orbbec", "oak"]
    assert not {"pyrealsense2", "pyorbbecsdk", "depthai"} & set(sys.modules)


# SDKs that look like theirs: the calls are those of their documentation.


class LooksLikeOrbbec:
    """As far of pyorbbecsdk as is called."""

    OBSensorType = SimpleNamespace(COLOR_SENSOR="color", DEPTH_SENSOR="depth")
    OBFormat = SimpleNamespace(RGB="rgb", Y16="y16")
    OBFrameAggregateOutputMode = SimpleNamespace(FULL_FRAME_REQUIRE=1)
    OBPropertyID = SimpleNamespace(OB_PROP_COLOR_AUTO_EXPOSURE_BOOL="exposure", OB_PROP_COLOR_AUTO_WHITE_BALANCE_BOOL=2)

    def __init__(self, serials: Sequence[str] = ("A1",)) -> None:
        self.serials = list(serials)
        self.properties: dict[Any, bool] = {}
        self.number = 0

    def Context(self) -> Any:  # noqa: ANN401, N802
        device = SimpleNamespace(
            get_device_info=lambda: SimpleNamespace(
                get_name=lambda: "Orbbec Gemini 2", get_firmware_version=lambda: "1.4.60"
            ),
            set_bool_property=self.properties.__setitem__,
        )
        devices = SimpleNamespace(
            get_count=lambda: len(self.serials),
            get_device_name_by_index=lambda _: "Orbbec Gemini 2",
            get_device_serial_number_by_index=self.serials.__getitem__,
            get_device_by_serial_number=lambda _: device,
        )
        return SimpleNamespace(query_devices=lambda: devices)

    def Config(self) -> Any:  # noqa: ANN401, N802
        return SimpleNamespace(enable_stream=lambda _: None, set_frame_aggregate_output_mode=lambda _: None)

    def Pipeline(self, device: Any) -> Any:  # noqa: ANN401, ARG002, N802
        camera = SimpleNamespace(width=WIDTH, height=HEIGHT, fx=10.0, fy=10.0, cx=3.5, cy=2.5)
        lens = SimpleNamespace(**dict.fromkeys(("k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2"), 0.0))
        placed = SimpleNamespace(rot=np.eye(3), transform=np.zeros(3))
        profile = SimpleNamespace(
            get_intrinsic=lambda: camera, get_distortion=lambda: lens, get_extrinsic_to=lambda _: placed
        )

        def only_another(*_: object) -> Any:  # noqa: ANN401
            raise RuntimeError("no such profile")

        profiles = SimpleNamespace(
            get_video_stream_profile=only_another, get_default_video_stream_profile=lambda: profile
        )
        return SimpleNamespace(
            get_stream_profile_list=lambda _: profiles, enable_frame_sync=lambda: None, start=lambda _: None,
            stop=lambda: None, wait_for_frames=self._frames,
        )  # fmt: skip

    def _frames(self, timeout_ms: int) -> Any:  # noqa: ANN401, ARG002
        if not self.serials:
            return None
        self.number += 1
        one = shot(self.number)
        picture = {"get_height": lambda: HEIGHT, "get_width": lambda: WIDTH}
        tenths = (one.depth_mm * 10).astype(np.uint16)
        depth = SimpleNamespace(
            **picture, get_data=lambda: tenths.view(np.uint8).ravel(), get_depth_scale=lambda: 0.1,
            get_index=lambda: one.number, get_timestamp_us=lambda: round(one.device_s * 1e6),
        )  # fmt: skip
        color = SimpleNamespace(**picture, get_data=lambda: one.color.ravel())
        return SimpleNamespace(get_depth_frame=lambda: depth, get_color_frame=lambda: color)


def test_orbbec() -> None:
    ob = LooksLikeOrbbec()
    assert listed_orbbecs(ob) == [PluggedDevice("orbbec", "Orbbec Gemini 2", "A1")]
    sensor = SdkSensor("orbbec", "Orbbec", "A1", lambda: OrbbecCamera(ob, "A1"), Projector.FIXED)
    walk(sensor)
    sensor.open()
    sensor.start()
    frame = sensor.read(5.0)
    assert frame.depth_mm[3, 3] == shot(ob.number).depth_mm[3, 3]
    assert (sensor.info.model, sensor.info.firmware) == ("Orbbec Gemini 2", "1.4.60")
    assert sensor.lock_color(True)
    assert set(ob.properties.values()) == {False}
    ob.serials.clear()
    with pytest.raises(WorldError, match="A1") as told:
        sensor.read(1.0)
    assert told.value.code == "sensor_gone"
    sensor.close()


class LooksLikeDepthai:
    """As far of depthai as is called."""

    CameraBoardSocket = SimpleNamespace(CAM_A=0, CAM_B=1, CAM_C=2)
    ImgFrame = SimpleNamespace(Type=SimpleNamespace(RGB888i="rgb"))
    node = SimpleNamespace(Camera="camera", StereoDepth="stereo", Sync="sync")

    def __init__(self) -> None:
        self.plugged, self.number = True, 0
        self.sent: list[Any] = []
        listed = SimpleNamespace(getDeviceId=lambda: "A1")
        self.Device: Any = lambda _: SimpleNamespace(
            getDeviceName=lambda: "OAK-D", isClosed=lambda: not self.plugged, close=lambda: None,
            readCalibration=lambda: SimpleNamespace(
                getCameraIntrinsics=lambda _, __, ___: [[10.0, 0.0, 3.5], [0.0, 10.0, 2.5], [0.0, 0.0, 1.0]]
            ),
        )  # fmt: skip
        self.Device.getAllConnectedDevices = lambda: [listed] if self.plugged else []

    def DeviceInfo(self, serial: str) -> str:  # noqa: N802
        return serial

    def CameraControl(self) -> Any:  # noqa: ANN401, N802
        held: dict[str, bool] = {}
        return SimpleNamespace(
            held=held, setAutoExposureLock=lambda on: held.update(exposure=on),
            setAutoWhiteBalanceLock=lambda on: held.update(white=on),
        )  # fmt: skip

    def Pipeline(self, device: Any) -> Any:  # noqa: ANN401, ARG002, N802
        return SimpleNamespace(create=self._create, start=lambda: None, stop=lambda: None)

    def _create(self, node: str) -> Any:  # noqa: ANN401
        output = SimpleNamespace(link=lambda _: None)
        if node == "sync":
            queue = SimpleNamespace(get=self._group)
            return SimpleNamespace(
                inputs={"color": 0, "depth": 1}, setSyncThreshold=lambda _: None,
                out=SimpleNamespace(createOutputQueue=lambda **_: queue),
            )  # fmt: skip
        built = SimpleNamespace(
            requestOutput=lambda *_, **__: output, depth=output, setDepthAlign=lambda _: None,
            setOutputSize=lambda _, __: None,
            inputControl=SimpleNamespace(createInputQueue=lambda: SimpleNamespace(send=self.sent.append)),
        )  # fmt: skip
        return SimpleNamespace(build=lambda *_: built)

    def _group(self, timeout: timedelta) -> Any:  # noqa: ANN401, ARG002
        self.number += 1
        one = shot(self.number)
        large = [np.repeat(np.repeat(picture, 80, 0), 80, 1) for picture in (one.color, one.depth_mm)]
        depth = SimpleNamespace(
            getFrame=lambda: large[1], getSequenceNum=lambda: one.number,
            getTimestampDevice=lambda: timedelta(seconds=one.device_s),
        )  # fmt: skip
        return {"color": SimpleNamespace(getFrame=lambda: large[0]), "depth": depth}


def test_oak() -> None:
    dai = LooksLikeDepthai()
    assert listed_oaks(dai) == [PluggedDevice("oak", "OAK", "A1")]
    sensor = SdkSensor("oak", "Luxonis", "A1", lambda: OakCamera(dai, "A1"), Projector.HARMLESS)
    walk(sensor)
    sensor.open()
    sensor.start()
    sensor.read(5.0)
    assert sensor.lock_color(True)
    assert dai.sent[-1].held == {"exposure": True, "white": True}
    dai.plugged = False
    with pytest.raises(WorldError, match="A1") as told:
        sensor.read(1.0)
    assert told.value.code == "sensor_gone"
    sensor.close()
