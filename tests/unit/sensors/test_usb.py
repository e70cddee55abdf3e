"""The USB tree read from made systems, what is found wrong there, and that garbage in sysfs harms nobody."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fruitgui.sensors.usb.bandwidth import DEPTH_BYTES, KINECT_US, PROMISED_US, bus_loads, stream_us
from fruitgui.sensors.usb.findings import look_over
from fruitgui.sensors.usb.holders import Holder, read_holders
from fruitgui.sensors.usb.known import Part, known_device
from fruitgui.sensors.usb.machine import Machine
from fruitgui.sensors.usb.tree import UsbDevice, read_tree
from tests.unit.sensors.made_system import MadeSystem, made_system

OWN = 99_999_999


def codes(system: MadeSystem) -> list[list[str]]:
    return [[one.code for one in sensor.problems] for sensor in look_over(system.machine, OWN).sensors]


def test_a_kinect_is_read_with_all_that_it_says(tmp_path: Path) -> None:
    system = made_system(tmp_path)
    camera = system.kinect("1-4", "A00364", driver="gspca_kinect")
    tree = read_tree(system.machine)
    (device,) = [one for one in tree.devices if one.path == camera]
    assert device == UsbDevice(
        bus=1, address=system.address(camera), ports=(4, 3), vendor=0x045E, product=0x02AE, release=0x010B,
        serial="A00364", speed_mbps=480.0, usb=2.0, drivers=("gspca_kinect",),
    )  # fmt: skip
    assert tree.controller(1) == tree.controller(2) == "0000:00:14.0"
    assert tree.buses[1].driver == "xhci_hcd"
    assert [one.path for one in tree.beside(device)] == ["1-4.1", "1-4.2"]
    assert tree.controller(7) is None


@pytest.mark.parametrize(
    ("vendor", "product", "release", "name", "make", "model"),
    [
        (0x045E, 0x02AE, 0x010B, "Xbox NUI Camera", "kinect", "Kinect 1414"),
        (0x045E, 0x02AE, 0x0119, "Xbox NUI Camera", "kinect", "Kinect 1473"),
        (0x045E, 0x02AE, 0, "", "kinect", "Kinect 360"),
        (0x045E, 0x02BF, 0x0219, "", "kinect", "Kinect for Windows"),
        (0x045E, 0x02D8, 0, "", "kinect_v2", "Kinect v2"),
        (0x045E, 0x097C, 0, "", "azure_kinect", "Azure Kinect"),
        (0x8086, 0x0B07, 0, "Intel(R) RealSense(TM) Depth Camera 435", "realsense", "RealSense D435"),
        (0x8086, 0x0FFF, 0, "Intel(R) RealSense Depth Camera 999", "realsense", "RealSense Depth Camera 999"),
        (0x2BC5, 0x0403, 0, "Astra", "orbbec", "Astra"),
        (0x2BC5, 0x0801, 0, "", "orbbec", "Orbbec"),
        (0x03E7, 0x2485, 0, "Movidius MyriadX", "oak", "OAK (asleep)"),
        (0x1D27, 0x0601, 0, "", "primesense", "Xtion or Carmine"),
    ],
)
def test_depth_sensors_are_known(vendor: int, product: int, release: int, name: str, make: str, model: str) -> None:
    known = known_device(UsbDevice(1, 2, (1,), vendor, product, release, name=name))
    assert known is not None
    assert (known.make, known.model, known.part) == (make, model, Part.SENSOR)


@pytest.mark.parametrize(
    ("vendor", "product"),
    [(0x1D6B, 2), (0x8086, 0x0001), (0x045E, 0x00CB), (0x045E, 0x02D9), (0x03E7, 1), (0x046D, 0xC52B)],
)
def test_mice_and_hubs_are_no_sensors(vendor: int, product: int) -> None:
    assert known_device(UsbDevice(1, 2, (1,), vendor, product)) is None


@pytest.mark.parametrize("product", [0x02B0, 0x02AD, 0x02BB, 0x02BE, 0x02C2, 0x02C3, 0x097D, 0x097E])
def test_parts_of_a_sensor_are_not_counted_as_one(product: int) -> None:
    known = known_device(UsbDevice(1, 2, (1,), 0x045E, product))
    assert known is not None
    assert known.part is not Part.SENSOR


def test_a_kinect_that_is_free_has_no_problem(tmp_path: Path) -> None:
    system = made_system(tmp_path)
    system.kinect("1-1", "A1")
    view = look_over(system.machine, OWN)
    assert codes(system) == [[]]
    assert view.problems == ()


def test_a_kinect_without_its_adapter_shows_only_its_motor(tmp_path: Path) -> None:
    system = made_system(tmp_path)
    system.kinect("1-1", "A1")
    system.kinect("1-2", "B2", powered=False)
    view = look_over(system.machine, OWN)
    assert [one.code for one in view.problems] == ["no_power"]
    assert len(view.sensors) == 1


def test_a_node_that_may_not_be_used_wants_the_rules_or_a_replug(tmp_path: Path) -> None:
    from fruitgui.sensors.usb.udev import rules_file, rules_target

    system = made_system(tmp_path)
    system.closed.add(system.kinect("1-1", "A1"))
    assert codes(system) == [["no_access"]]
    target = rules_target(system.machine)
    target.parent.mkdir()
    target.write_bytes(rules_file().read_bytes())
    assert codes(system) == [["no_access_yet"]]
    target.write_text("# older rules\n")
    assert codes(system) == [["no_access"]]


def test_a_device_without_a_node_is_said(tmp_path: Path) -> None:
    system = made_system(tmp_path)
    system.plug("1-1", 0x045E, 0x02AE, node=False)
    assert codes(system) == [["no_node"]]


def test_whoever_holds_a_device_is_named(tmp_path: Path) -> None:
    system = made_system(tmp_path)
    camera, other = system.kinect("1-1", "A1"), system.kinect("1-2", "B2")
    system.run(17, "cheese", camera)
    system.run(123, "fruitgui", camera, other)
    system.run(OWN, "python", other)
    first, second = look_over(system.machine, OWN).sensors
    assert first.problems[0].what == "Another program has it open: cheese (process 17), fruitgui (process 123)."
    assert second.problems[0].values == {"programs": "fruitgui (process 123)"}
    held = read_holders(system.machine, OWN)
    assert held[1, system.address(other)] == (Holder(123, "fruitgui"),)


def test_the_kernels_webcam_driver_is_said(tmp_path: Path) -> None:
    system = made_system(tmp_path)
    system.kinect("1-1", "A1", driver="gspca_kinect")
    assert codes(system) == [["kernel_driver"]]


@pytest.mark.parametrize(
    ("vendor", "product", "speed", "expected"),
    [
        (0x8086, 0x0B07, 480, ["slow_port"]),
        (0x8086, 0x0B07, 5000, []),
        (0x8086, 0x0B07, 10000, []),
        (0x03E7, 0x2485, 480, []),
        (0x03E7, 0xF63B, 480, ["slow_port"]),
        (0x045E, 0x02AE, 12, ["slow_port"]),
        (0x045E, 0x02D8, 480, ["slow_port"]),
    ],
)
def test_a_port_that_is_too_slow_is_said(
    tmp_path: Path, vendor: int, product: int, speed: float, expected: list[str]
) -> None:
    system = made_system(tmp_path)
    system.plug("1-3", vendor, product, speed=speed)
    assert codes(system) == [expected]


def test_one_kinect_fits_on_a_bus_and_two_with_depth_alone() -> None:
    # 1920 and 1760 bytes in nearly every microframe, of 100 promised µs.
    assert KINECT_US < PROMISED_US < KINECT_US + stream_us(DEPTH_BYTES)
    assert 2 * stream_us(DEPTH_BYTES) < PROMISED_US < 3 * stream_us(DEPTH_BYTES)
    assert stream_us(1024) == pytest.approx(0.64 + 1024 * 8 * 7 / 6 / 480, abs=0.02)


@pytest.mark.parametrize(
    ("buses", "fit"),
    [([1], {1: True}), ([1, 1], {1: False}), ([1, 3], {1: True, 3: True}), ([1, 3, 3], {1: True, 3: False}), ([], {})],
)
def test_kinects_fit_one_to_a_bus(buses: list[int], fit: dict[int, bool]) -> None:
    loads = bus_loads((bus, f"kinect_{number}") for number, bus in enumerate(buses))
    assert {load.bus: load.fits for load in loads} == fit
    assert sorted(name for load in loads for name in load.kinects) == [f"kinect_{n}" for n in range(len(buses))]


@pytest.mark.parametrize(("kinects", "memory", "short"), [(1, 16, False), (3, 2, True), (3, 0, False), (3, "x", False)])
def test_memory_for_usb_that_is_short_is_said(tmp_path: Path, kinects: int, memory: object, short: bool) -> None:
    system = made_system(tmp_path)
    for number in range(kinects):
        system.kinect(f"1-{number + 1}", f"A{number}")
    system.usbfs_memory(memory)
    assert [one.code for one in look_over(system.machine, OWN).problems] == ["usbfs_memory"] * short


def test_a_system_without_usb_is_empty(tmp_path: Path) -> None:
    view = look_over(Machine(tmp_path / "nowhere"), OWN)
    assert not view.shown
    assert view.sensors == view.problems == ()


def test_the_system_that_runs_is_looked_over() -> None:
    look_over(Machine(), os.getpid())


def test_what_a_device_says_cannot_steer_a_terminal(tmp_path: Path) -> None:
    system = made_system(tmp_path)
    system.plug("1-1", 0x2BC5, 0x0403, name="\x1b[2JAstra\x07", serial="A" * 5000)
    (sensor,) = look_over(system.machine, OWN).sensors
    assert sensor.known.model == "[2JAstra"
    assert len(sensor.device.serial) == 128


def _loop(place: Path) -> None:
    place.unlink(missing_ok=True)
    place.symlink_to(place.name)


def _folder(place: Path) -> None:
    place.unlink(missing_ok=True)
    place.mkdir()


def _closed(place: Path) -> None:
    place.unlink(missing_ok=True)
    place.symlink_to("nowhere/at/all")


FILES = st.sampled_from(
    ["idVendor", "idProduct", "bcdDevice", "devnum", "busnum", "speed", "serial", "product", "version", "bMaxPower",
     "manufacturer"]
)  # fmt: skip
SPOILT: st.SearchStrategy[bytes | Callable[[Path], None]] = st.one_of(
    st.binary(max_size=200),
    st.text(max_size=40).map(lambda text: text.encode("utf-8", "surrogatepass")),
    st.integers(-(10**30), 10**30).map(lambda number: str(number).encode()),
    st.sampled_from([b"", b"-1\n", b"0x12", b"ffff\n", b"10000\n", b"1e9", b"nan", b"inf", "١٢".encode(), b"9" * 5000]),
    st.sampled_from([_loop, _folder, _closed]),
)


@settings(max_examples=40)
@given(st.dictionaries(FILES, SPOILT, max_size=6), st.sampled_from(["1-1.3", "1-1", "usb1"]))
def test_garbage_in_sysfs_is_never_an_error(spoilt: dict[str, bytes | Callable[[Path], None]], where: str) -> None:
    with tempfile.TemporaryDirectory() as folder:
        system = made_system(Path(folder))
        system.kinect("1-1", "A1", driver="gspca_kinect")
        place = (system.machine.usb_devices / where).resolve()
        for name, content in spoilt.items():
            if isinstance(content, bytes):
                (place / name).write_bytes(content)
            else:
                content(place / name)
        view = look_over(system.machine, OWN)
        assert all(one.what and one.remedy for one in view.problems)
        assert all(0 <= one.device.vendor <= 0xFFFF for one in view.sensors)


@settings(max_examples=40)
@given(st.lists(st.text(st.characters(exclude_characters="/\0", exclude_categories=("Cs",)), min_size=1, max_size=30)))
def test_entries_with_any_name_are_never_an_error(names: list[str]) -> None:
    with tempfile.TemporaryDirectory() as folder:
        system = made_system(Path(folder))
        for name in {name for name in names if len(name.encode()) < 200} - {".", ".."}:
            entry = system.machine.usb_devices / name
            if not entry.is_symlink():
                entry.mkdir()
                (entry / "idVendor").write_text("045e")
                (entry / "idProduct").write_text("02ae")
                (entry / "devnum").write_text("3")
            process = system.machine.processes / name
            process.mkdir()
            (process / "fd").symlink_to("fd")
        look_over(system.machine, OWN)


@pytest.mark.parametrize("name", ["1-1" + ".1" * 40, "usb99999", "1-", "-1", "1-1:", ":", "usb", "0-0", "9999-999.999"])
def test_strange_names_of_entries_are_never_an_error(tmp_path: Path, name: str) -> None:
    system = made_system(tmp_path)
    entry = system.machine.usb_devices / name
    entry.mkdir()
    (entry / "driver").symlink_to("driver")
    for file, text in (("idVendor", "045e"), ("idProduct", "02ae"), ("devnum", "3")):
        (entry / file).write_text(text)
    look_over(system.machine, OWN)
