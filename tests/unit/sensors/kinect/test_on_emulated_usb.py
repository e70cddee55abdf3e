"""The real libfreenect over an emulated USB bus: what arrives, what is lost, what comes and goes."""

from __future__ import annotations

import ctypes
import time
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from fruitgui.errors import WorldError
from fruitgui.frame import U16, Frame
from fruitgui.sensors.kinect import session
from fruitgui.sensors.kinect.bus import Bus
from fruitgui.sensors.kinect.clock import FRAME_TICKS
from fruitgui.sensors.kinect.depth_table import ZeroPlane, depth_table
from fruitgui.sensors.kinect.device import Device, Picture
from fruitgui.sensors.kinect.driver import KinectDriver
from fruitgui.sensors.kinect.library import libfreenect, libusb
from fruitgui.sensors.kinect.motor import Led, Motor
from fruitgui.sensors.kinect.packets import Stream
from fruitgui.sensors.kinect.sensor import KinectSensor
from fruitgui.sensors.sensor import SensorTimeoutError
from tests.emulated_usb import pictures
from tests.emulated_usb.emulation import (
    DEPTH_ON,
    DEPTH_REGISTER,
    MODEL_1473,
    MODEL_K4W,
    TILT,
    Emulation,
    Garbage,
    Hang,
    Kinect,
)
from tests.emulated_usb.factory_made import registration_bytes
from tests.emulated_usb.outside import inside
from tests.unit.sensors.scripted import until

READ_S = 20.0


def sensors_of(*serials: str, driver: KinectDriver | None = None) -> list[KinectSensor]:
    driver = driver or KinectDriver()
    sensors = [driver.sensor(serial) for serial in serials]
    for sensor in sensors:
        sensor.open()
        sensor.start()
    return sensors


def let_go(sensors: Sequence[KinectSensor]) -> None:
    for sensor in sensors:
        sensor.stop()
        sensor.close()


def push(usb: Emulation, number: int, count: int, *, raw: U16 | None = None, ticks: int | None = None) -> int:
    """Push a picture of each stream, taken at the same moment; return how many packets of depth were lost."""
    at = count * FRAME_TICKS if ticks is None else ticks
    assert usb.push_video(number, pictures.grey(100 + count % 100), at) >= 0
    return usb.push_depth(number, pictures.level(700) if raw is None else raw, at + 60_000)


@inside
def test_models_are_told_apart_with_what_each_cannot_do(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"), Kinect("B2", MODEL_1473), Kinect("C3", MODEL_K4W, bus=1))
    devices = KinectDriver().devices()
    assert [(one.make, one.model, one.serial, one.bus) for one in devices] == [
        ("kinect", "Kinect 1414", "A1", 1),
        ("kinect", "Kinect 1473", "B2", 2),
        ("kinect", "Kinect for Windows", "C3", 1),
    ]
    assert devices[0].limits == ()
    assert all("accelerometer" in one.limits[0] for one in devices[1:])


@inside
def test_raw_depth_arrives_bit_by_bit_from_four_at_once(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    serials = ("A1", "B2", "C3", "D4")
    usb.plug_in(*(Kinect(serial) for serial in serials))
    heard: dict[str, list[Picture]] = {serial: [] for serial in serials}
    devices = []
    for serial in serials:

        def hear(stream: Stream, picture: Picture, into: list[Picture] = heard[serial]) -> None:
            if stream is Stream.DEPTH:
                into.append(picture)

        device = Device(libfreenect(), Bus(libusb()), serial, hear)
        device.open()
        device.switch(Stream.DEPTH, on=True)
        devices.append(device)
    sent = {
        serial: [pictures.noise(100 * number + count) for count in range(5)] for number, serial in enumerate(serials)
    }
    for count in range(5):
        for number, (serial, device) in enumerate(zip(serials, devices, strict=True)):
            assert usb.push_depth(number, sent[serial][count], 7 + count) == 0
            while len(heard[serial]) <= count:
                device.pump(0.01)
    for device in devices:
        device.stop()
        device.close()
    for serial in serials:
        assert [picture.stamp for picture in heard[serial]] == [7, 8, 9, 10, 11]
        assert all(picture.whole for picture in heard[serial])
        assert all((got.pixels == put).all() for got, put in zip(heard[serial], sent[serial], strict=True))


@inside
def test_two_sensors_give_their_own_frames(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"), Kinect("B2"))
    sensors = sensors_of("B2", "A1")
    for count in range(10):
        for number, raw in ((0, 600), (1, 800)):
            assert push(usb, number, count, raw=pictures.level(raw)) == 0
        b2, a1 = (sensor.read(READ_S) for sensor in sensors)
        assert (a1.sequence, b2.sequence) == (count, count)
        assert not a1.damaged
        assert not b2.damaged
        # 10 · 120 · 7.5 / (7.5 − 0.1042 (raw/4 − 200.375)) mm, by hand
        assert set(np.unique(a1.depth_mm)) == {0, 706}
        assert set(np.unique(b2.depth_mm)) == {0, 1194}
        assert (a1.depth_mm > 0).mean() > 0.8
        assert a1.color.mean() == pytest.approx(100 + count, abs=1)
    let_go(sensors)


@inside
def test_all_frames_have_the_host_s_time_whatever_each_device_s_clock_says(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"), Kinect("B2"))
    host_s = 500.0
    driver = KinectDriver(lambda: host_s)
    sensors = sensors_of("A1", "B2", driver=driver)
    begin = (2**32 - 50 * FRAME_TICKS, 123_456)  # one begins again on the way
    rng = np.random.default_rng(4)
    for count in range(90):
        taken_s = 500.0 + count / 30.0
        for number, sensor in enumerate(sensors):
            host_s = taken_s + 0.005 + float(rng.exponential(0.01))
            ticks = begin[number] + round(count * FRAME_TICKS * (1.0 + (50e-6, -50e-6)[number]))
            push(usb, number, count, ticks=ticks)
            frame = sensor.read(READ_S)
            assert frame.sequence == count
            if count >= 30:
                assert frame.time_s == pytest.approx(taken_s + 0.005, abs=2e-3)
    let_go(sensors)


@inside
def test_lost_packets_mark_the_frame_and_no_other(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"), Kinect("B2"))
    sensors = sensors_of("A1", "B2")
    for count in range(24):
        if count % 3 == 1:
            # from the first picture on, up to five, which the library bridges: in the middle, and at both ends
            usb.lose(0, (100, 1, 236)[count % 9 // 3], 1 + count % 5)
        lost = push(usb, 0, count, raw=pictures.level(600 + count))
        assert push(usb, 1, count) == 0
        assert (lost > 0) == (count % 3 == 1)
        first, second = (sensor.read(READ_S) for sensor in sensors)
        assert (first.sequence, first.damaged) == (count, lost > 0)
        assert not second.damaged
    let_go(sensors)


@inside
def test_a_loss_across_two_frames_marks_both(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"))
    sensors = sensors_of("A1")
    marks = []
    for count in range(6):
        if count == 2:
            usb.lose(0, 240, 2)
        push(usb, 0, count)
        if count == 2:
            continue  # its end never comes: the library hands it on with the next one
        if count == 3:
            usb_marks = [sensors[0].read(READ_S).damaged]
            marks += usb_marks
        marks.append(sensors[0].read(READ_S).damaged)
    assert marks == [False, False, True, False, False, False]
    let_go(sensors)


@inside
def test_whole_pictures_that_are_missing_leave_a_gap_in_the_numbers(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"))
    sensors = sensors_of("A1")
    numbers = []
    for count in range(12):
        if count == 5:
            usb.lose(0, 20, 100)  # too many: the library lets the picture go
        lost = push(usb, 0, count)
        if not lost:
            numbers.append(sensors[0].read(READ_S).sequence)
    assert numbers == [0, 1, 2, 3, 4, 6, 7, 8, 9, 10, 11]
    let_go(sensors)


@inside
def test_garbage_never_passes_for_a_whole_frame(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"))
    sensors = sensors_of("A1")
    for kind in Garbage:
        usb.garbage(0, kind)
        for count in range(6):
            push(usb, 0, 10 * kind + count, raw=pictures.level(700))
        for frame in _whatever_comes(sensors[0]):
            whole = set(np.unique(frame.depth_mm)) <= {0, 887}
            assert frame.damaged or whole
    usb.garbage(0, Garbage.NONE)
    for count in range(6):
        push(usb, 0, 100 + count)
    last = _whatever_comes(sensors[0])[-1]
    assert not last.damaged
    let_go(sensors)


def _whatever_comes(sensor: KinectSensor) -> list[Frame]:
    frames = []
    while True:
        try:
            frames.append(sensor.read(0.5))
        except SensorTimeoutError:
            return frames


@inside
def test_one_that_is_unplugged_is_known_at_once_and_the_other_goes_on(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"), Kinect("B2"))
    sensors = sensors_of("A1", "B2")
    for count in range(3):
        push(usb, 0, count)
        push(usb, 1, count)
        for sensor in sensors:
            sensor.read(READ_S)
    usb.plug(0, on=False)
    with pytest.raises(WorldError) as gone:
        sensors[0].read(READ_S)
    assert gone.value.code == "sensor_gone"
    with pytest.raises(WorldError):
        sensors[0].open()
    for count in range(3, 8):
        push(usb, 1, count)
        assert sensors[1].read(READ_S).sequence == count
    usb.plug(0, on=True)
    sensors[0].open()
    sensors[0].start()
    push(usb, 0, 0)
    assert not sensors[0].read(READ_S).damaged
    let_go(sensors)


@inside
def test_the_projector_is_dark_while_depth_is_off_and_colour_goes_on(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"), Kinect("B2"))
    driver = KinectDriver()
    sensors = [driver.sensor(serial) for serial in ("A1", "B2")]
    for sensor in sensors:
        sensor.open()
        sensor.projector(on=False)
        sensor.start()
    assert not usb.shines(0)
    assert not usb.shines(1)
    for turn in range(6):
        shining, dark = sensors[turn % 2], sensors[1 - turn % 2]
        dark.projector(on=False)
        shining.projector(on=True)
        assert [usb.shines(0), usb.shines(1)] == [turn % 2 == 0, turn % 2 == 1]
        assert push(usb, turn % 2, turn) == 0
        assert push(usb, 1 - turn % 2, turn) == -1
        assert shining.read(READ_S).sequence == turn // 2
        with pytest.raises(SensorTimeoutError):
            dark.read(0.0)
    lit: set[int] = set()
    for written in usb.log():
        if written.register == DEPTH_REGISTER:
            (lit.add if written.value == DEPTH_ON else lit.discard)(written.kinect)
        assert len(lit) < 2
    let_go(sensors)
    assert not usb.shines(0)
    assert not usb.shines(1)


@inside
def test_a_serial_finds_its_camera_whatever_may_not_be_opened(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    # the library's own way to a serial counts only those that may be opened, and would take the second here
    usb.plug_in(Kinect("A1"), Kinect("B2"), Kinect("C3"))
    usb.denied(0, on=True)
    sensors = sensors_of("C3")
    push(usb, 2, 0)
    assert sensors[0].read(READ_S).sequence == 0
    assert not usb.shines(1)
    let_go(sensors)
    devices = KinectDriver().devices()
    assert [one.serial for one in devices] == ["", "B2", "C3"]
    assert "--install-udev-rules" in devices[0].limits[0]


@inside
def test_why_a_serial_is_not_known_is_said(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"), Kinect(""), Kinect("C3"), Kinect("D4"), Kinect("D4"))
    usb.hang(2, Hang.CONTROL)
    usb.denied(0, on=True)
    driver = KinectDriver()
    until(lambda: len(driver.devices()) == 5)
    devices = driver.devices()
    assert [one.hindrance for one in devices] == ["closed", "no_serial", "hangs", "no_serial", "no_serial"]
    assert "does not answer" in devices[2].limits[-1]
    usb.denied(0, on=False)
    assert _code(driver.sensor("C3")) == "sensor_hangs"


@inside
def test_a_microphone_that_starts_anew_when_its_kinect_is_opened_is_waited_for(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"), Kinect("B2", MODEL_1473))
    usb.restarts(1, 3)
    sensors = sensors_of("B2")
    push(usb, 1, 0)
    assert not sensors[0].read(READ_S).damaged
    let_go(sensors)


@inside
def test_without_hubs_a_part_is_a_camera_s_where_both_are_alone_on_their_bus(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1", bus=1), Kinect("B2", bus=2), Kinect("C3", bus=2), Kinect("D4", MODEL_K4W, bus=3))
    usb.no_hubs(on=True)
    sensors = sensors_of("A1", "B2", "D4")
    assert [usb.led(number) for number in range(3)] == [Led.GREEN, 0, 0]
    let_go(sensors)


@inside
def test_what_hinders_opening_is_said_with_a_remedy(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"), Kinect("B2"), Kinect("B2"))
    driver = KinectDriver()
    usb.busy(0, on=True)
    assert _code(driver.sensor("A1")) == "sensor_busy"
    usb.busy(0, on=False)
    usb.denied(0, on=True)
    assert _code(driver.sensor("A1")) == "sensor_not_allowed"
    usb.denied(0, on=False)
    usb.stall(0, on=True)
    assert _code(driver.sensor("A1")) == "sensor_not_obeyed"
    usb.stall(0, on=False)
    assert _code(driver.sensor("B2")) == "sensor_twice"
    assert _code(driver.sensor("Z9")) == "sensor_gone"
    usb.kernel_driver(0, on=True, stays=True)
    assert _code(driver.sensor("A1")) == "sensor_held"
    usb.kernel_driver(0, on=True)
    sensor = driver.sensor("A1")
    sensor.open()
    usb.no_bandwidth(0, on=True)
    with pytest.raises(WorldError) as full:
        sensor.start()
    assert full.value.code == "usb_full"
    usb.no_bandwidth(0, on=False)
    sensor.start()
    push(usb, 0, 0)
    sensor.read(READ_S)
    usb.stall(0, on=True)
    with pytest.raises(WorldError) as stalled:
        sensor.projector(on=False)
    assert stalled.value.code == "sensor_not_obeyed"
    usb.stall(0, on=False)
    sensor.close()


def _code(sensor: KinectSensor) -> str:
    with pytest.raises(WorldError) as refused:
        sensor.open()
    assert refused.value.remedy
    sensor.close()
    return refused.value.code


@inside
def test_one_that_hangs_holds_up_nobody(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"), Kinect("B2"))
    driver = KinectDriver()
    sensors = sensors_of("A1", "B2", driver=driver)
    for hanging in (Hang.EVENTS, Hang.CONTROL):
        usb.hang(0, hanging)
        with pytest.raises(SensorTimeoutError):
            sensors[0].read(0.05)
        with pytest.raises(WorldError) as hung:
            sensors[0].projector(on=False)
        assert hung.value.code == "sensor_hangs"
        push(usb, 1, 0)
        sensors[1].read(READ_S)
        sensors[0].close()
        for again in (sensors[0], driver.sensor("A1")):
            with pytest.raises(WorldError) as hung:
                again.open()
            assert hung.value.code == "sensor_hangs"
        usb.plug(0, on=False)
        usb.plug(0, on=True)
        _reopened(sensors[0])
        push(usb, 0, 0)
        assert not sensors[0].read(READ_S).damaged
    let_go(sensors)


@inside
def test_one_that_answers_without_a_byte_for_ever_is_named(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"), Kinect("B2"))
    usb.hang(0, Hang.EMPTY)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(session, "OPEN_S", 0.5)  # the library would ask for ever
        assert _code(KinectDriver().sensor("A1")) == "sensor_hangs"
    let_go(sensors_of("B2"))
    usb.hang(0, Hang.NOTHING)


@inside
def test_opening_ends_in_time_however_many_others_do_not_answer(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    """Each that is mute keeps whoever asks for its serial waiting a second, and all are asked more than once."""
    mute = tuple(f"M{number}" for number in range(6))
    usb.plug_in(Kinect("A1"), *(Kinect(serial) for serial in mute))
    let_go(sensors_of("A1"))  # what is loaded and made for the first time does not count
    for number in range(1, 1 + len(mute)):
        usb.hang(number, Hang.CONTROL)
    for serial, code in (("A1", ""), ("M3", "sensor_hangs")):
        sensor = KinectDriver().sensor(serial)
        began_s = time.monotonic()
        if code:
            assert _code(sensor) == code
        else:
            sensor.open()
        assert time.monotonic() - began_s < session.OPEN_S
        sensor.close()


def _reopened(sensor: KinectSensor) -> None:
    end_s = time.monotonic() + 30.0
    while True:
        try:
            sensor.open()
            sensor.projector(on=True)
            sensor.start()
        except WorldError:
            assert time.monotonic() < end_s
            time.sleep(0.05)
        else:
            return


@inside
def test_every_start_and_stop_leaves_nothing_behind(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"), Kinect("B2"))
    sensors = sensors_of("A1", "B2")
    let_go(sensors)
    for _ in range(10):
        for sensor in sensors:
            sensor.open()
            sensor.start()
        for sensor in sensors:
            sensor.stop()
            sensor.close()
        assert usb.left_open == (0, 0, 0)


@inside
def test_colours_are_where_the_camera_has_them(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"))
    sensors = sensors_of("A1")
    bayer = pictures.grey(0)
    bayer[0::2, 1::2], bayer[0::2, 0::2], bayer[1::2, 1::2], bayer[1::2, 0::2] = 200, 120, 120, 40  # G R, B G
    usb.push_video(0, bayer, 5)
    usb.push_depth(0, pictures.level(700), 5)
    assert np.median(sensors[0].read(READ_S).color.reshape(-1, 3), axis=0).tolist() == [200, 120, 40]
    let_go(sensors)


@inside
def test_exposure_and_white_balance_can_be_held(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"))
    sensors = sensors_of("A1")
    automatic = 1 << 14 | 1 << 1
    assert usb.cmos(0, 0x106) & automatic == automatic
    assert sensors[0].lock_color(on=True)
    assert usb.cmos(0, 0x106) & automatic == 0
    assert sensors[0].lock_color(on=False)
    assert usb.cmos(0, 0x106) & automatic == automatic
    let_go(sensors)


@inside
def test_light_and_accelerometer_are_this_kinect_s_own(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"), Kinect("B2"), Kinect("C3"))
    usb.motor_order((2, 0, 1))  # the library would take the motor of another one
    usb.accelerate(1, 0, 819, -164)
    sensors = sensors_of("B2")
    assert [usb.led(number) for number in range(3)] == [0, Led.GREEN, 0]
    push(usb, 1, 0)
    felt = sensors[0].read(READ_S).felt_m_s2
    assert felt == pytest.approx((0.0, 9.80665, -9.80665 * 164 / 819))
    let_go(sensors)
    assert [usb.led(number) for number in range(3)] == [0, Led.BLINKING_GREEN, 0]
    motor = Motor(Bus(libusb()), "C3")
    assert motor.open()
    assert motor.tilt(-12.0)
    assert motor.tilt(90.0)
    motor.close()
    assert [(one.kinect, one.value) for one in usb.log() if one.register == TILT] == [(2, -24 & 0xFFFF), (2, 62)]


@inside
def test_models_without_a_motor_of_their_own_run_all_the_same(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1", MODEL_1473), Kinect("B2", MODEL_K4W), Kinect("C3"))
    sensors = sensors_of("A1", "B2")
    assert [sensor.info.model for sensor in sensors] == ["Kinect 1473", "Kinect for Windows"]
    assert {sensor.info.firmware for sensor in sensors} == {"1.15"}
    for number, sensor in enumerate(sensors):
        push(usb, number, 0)
        frame = sensor.read(READ_S)
        assert frame.felt_m_s2 is None
        assert not frame.damaged
    assert usb.led(2) == 0
    let_go(sensors)


@inside
def test_the_factory_s_words_are_understood_as_the_library_does(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1", registration=registration_bytes(530.0, (322.0, 236.0), 0.04, -0.01)))
    freenect = libfreenect()
    device = Device(freenect, Bus(libusb()), "A1", lambda _stream, _picture: None)
    opened = device.open()
    says = freenect.copy_registration(device.handle)
    # depth: the library cuts fractions off
    own = depth_table(opened.factory.zero_plane).astype(int)
    its = np.ctypeslib.as_array(says.raw_to_mm, (2048,)).astype(int)
    assert set((own - its)[:1055]) <= {0, 1}
    # places: in steps of 1/256 along the rows, whole pixels across; it adds up differences that are cut off as well
    table = np.ctypeslib.as_array(says.table, (480 * 640,)).reshape(480, 640, 2)
    v, u = (one.astype(float) for one in np.mgrid[0:480, 0:640])
    at_m = 1.2
    shift = np.ctypeslib.as_array(says.depth_to_rgb, (10000,))[round(at_m * 1000)]
    own_u, own_v = opened.factory.color_pixels(u, v, np.full(u.shape, at_m))
    inside_picture = table[..., 0] < 2 * 640 * 256
    assert inside_picture.mean() > 0.9
    assert np.abs((table[..., 0] + shift) / 256.0 - 0.5 - own_u)[inside_picture].max() < 0.06
    assert np.abs(table[..., 1] - own_v)[inside_picture].max() < 0.56
    freenect.destroy_registration(ctypes.byref(says))
    device.close()


@inside
def test_one_that_answers_nothing_but_zeros_of_itself_is_a_usual_one(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1", zero_plane=ZeroPlane(0.0, 0.0, 0.0, 0.0), registration=bytes(116)))
    sensors = sensors_of("A1")
    push(usb, 0, 0, raw=pictures.level(700))
    depth_mm = sensors[0].read(READ_S).depth_mm
    assert set(np.unique(depth_mm[depth_mm > 0])) == {depth_table(ZeroPlane())[700]}
    assert (depth_mm > 0).mean() > 0.9
    let_go(sensors)


@inside
def test_one_that_is_given_back_keeps_no_pictures(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"))
    (sensor,) = sensors_of("A1")
    waiting = sensor._captures._waiting
    end_s, count = time.monotonic() + READ_S, 0
    while len(waiting) < 2 and time.monotonic() < end_s:
        push(usb, 0, count := count + 1)
    assert len(waiting) >= 2
    usb.plug(0, on=False)
    sensor.close()
    assert not waiting
    assert not sensor._captures._pairing._depth
    assert not sensor._captures._pairing._color
