"""The checkup on made systems with made drivers: each sensor once, with its place, its state and its remedies."""

from __future__ import annotations

import json
import math
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from fruitgui.errors import CancelledByUserError, WorldError
from fruitgui.progress import never_cancelled, no_progress
from fruitgui.sensors.drivers import PluggedDevice
from fruitgui.sensors.usb.machine import Machine
from fruitgui.sensors.usb.problems import WORDS, problem
from fruitgui.station.checkup import measuring
from fruitgui.station.checkup.job import CheckupPlan, check_up
from fruitgui.station.checkup.records import CheckedSensor, Checkup, SensorState
from tests.unit.sensors.made_system import MadeSystem, made_system
from tests.unit.station.made_drivers import MadeDriver, kinects

SECONDS = 1.0


def look(system: MadeSystem | Path, *drivers: MadeDriver, seconds: float = 0.0, answer_s: float = 20.0) -> Checkup:
    machine = Machine(system) if isinstance(system, Path) else system.machine
    return check_up(CheckupPlan(seconds, machine, drivers, answer_s=answer_s))


def codes(sensor: CheckedSensor) -> list[str]:
    return [one.code for one in sensor.problems]


def test_two_kinects_on_controllers_of_their_own_are_fine(tmp_path: Path) -> None:
    system = made_system(tmp_path)
    system.controller("0000:05:00.0", 3)
    system.kinect("1-1", "A1")
    system.kinect("3-2", "B2")
    found = look(system, kinects("B2", "A1"))
    assert found.all_problems == ()
    assert [(one.name, one.serial, one.place.bus, one.place.controller) for one in found.sensors] == [
        ("kinect_1", "B2", 3, "0000:05:00.0"),
        ("kinect_2", "A1", 1, "0000:00:14.0"),
    ]
    assert [one.state for one in found.sensors] == [SensorState.READY] * 2
    assert [(one.address, one.buses, one.sensors) for one in found.controllers] == [
        ("0000:00:14.0", (1, 2), ("kinect_2",)),
        ("0000:05:00.0", (3,), ("kinect_1",)),
    ]


def test_the_object_is_the_one_that_other_programs_know(tmp_path: Path) -> None:
    system = made_system(tmp_path)
    system.kinect("1-1", "A1")
    value = json.loads(json.dumps(look(system, kinects("A1"), seconds=SECONDS).value(), allow_nan=False))
    assert {"sensors", "problems"} <= value.keys()
    (sensor,) = value["sensors"]
    assert {"id", "make", "model", "serial", "state", "problems", "rate_hz", "lost_frames", "usb"} <= sensor.keys()
    assert sensor["state"] == "running"
    assert set(sensor["rate_hz"]) == {"color", "depth"}
    assert sensor["rate_hz"]["color"] > 1.0
    assert sensor["lost_frames"] == 0
    assert sensor["usb"] | {"bus": 1, "controller": "0000:00:14.0"} == sensor["usb"]
    system.closed.add("1-1.3")
    value = look(system, kinects()).value()
    assert {"what", "remedy"} <= value["sensors"][0]["problems"][0].keys()
    assert value["sensors"][0]["rate_hz"] == {"color": None, "depth": None}


def test_two_kinects_on_one_controller_do_not_fit(tmp_path: Path) -> None:
    system = made_system(tmp_path)
    system.kinect("1-1", "A1")
    system.kinect("1-2", "B2")
    found = look(system, kinects("A1", "B2"))
    (full,) = found.problems
    assert full.code == "buses_full"
    assert "USB card" in full.remedy
    assert full.values == {"sensors": "kinect_1, kinect_2", "controller": "0000:00:14.0, bus 1"}
    assert found.controllers[0].load == pytest.approx(1.46, abs=0.02)
    assert found.value()["controllers"][0]["fits"] is False
    system.controller("0000:05:00.0", 3)
    (full,) = look(system, kinects("A1", "B2")).problems
    assert full.code == "bus_full"
    assert "0000:05:00.0" in full.remedy


def test_nothing_connected_says_what_to_check(tmp_path: Path) -> None:
    found = look(made_system(tmp_path), kinects(), seconds=SECONDS)
    assert found.sensors == ()
    assert [one.code for one in found.problems] == ["nothing_connected"]
    assert "power" in found.problems[0].remedy


def test_a_system_without_usb_says_so(tmp_path: Path) -> None:
    assert [one.code for one in look(tmp_path, kinects()).problems] == ["no_usb"]


def test_a_kinect_without_power_is_not_nothing(tmp_path: Path) -> None:
    system = made_system(tmp_path)
    system.kinect("1-1", "A1", powered=False)
    assert [one.code for one in look(system, kinects()).problems] == ["no_power"]


def test_what_the_system_does_not_show_appears_as_its_driver_lists_it(tmp_path: Path) -> None:
    placed = PluggedDevice("kinect", "Kinect 1473", "B2", "2.1", ("It has no motor.",), 3, 7, (1, 4))
    driver = MadeDriver("kinect", [PluggedDevice("kinect", "Kinect 1414", "A1"), placed])
    found = look(tmp_path, driver)
    assert found.problems == ()
    first, second = found.sensors
    assert (first.place.bus, first.place.port) == (None, None)
    assert (second.place.bus, second.place.controller, second.place.port) == (3, None, "3-1.4")
    assert (second.firmware, second.limits) == ("2.1", ("It has no motor.",))


def test_a_driver_that_knows_the_address_finds_its_sensor_by_it(tmp_path: Path) -> None:
    system = made_system(tmp_path)
    system.controller("0000:05:00.0", 3)
    zeros = "0000000000000000"
    first, second = system.kinect("1-1", zeros), system.kinect("3-1", zeros)
    found = look(
        system,
        MadeDriver("kinect", [
            PluggedDevice("kinect", "Kinect 1473", "audio-2", bus=3, address=system.address(second)),
            PluggedDevice("kinect", "Kinect 1473", "audio-1", bus=1, address=system.address(first)),
        ]),
    )  # fmt: skip
    assert [(one.serial, one.place.port) for one in found.sensors] == [("audio-2", "3-1.3"), ("audio-1", "1-1.3")]


def test_a_serial_that_only_the_microphone_has_finds_its_sensor(tmp_path: Path) -> None:
    system = made_system(tmp_path)
    system.kinect("1-1", "0000000000000000", microphone="M1")
    system.kinect("1-2", "0000000000000000", microphone="M2")
    listed = [PluggedDevice("kinect", "Kinect 1473", serial, bus=1) for serial in ("M2", "M1")]
    found = look(system, MadeDriver("kinect", listed))
    assert [(one.serial, one.place.port) for one in found.sensors] == [("M2", "1-2.3"), ("M1", "1-1.3")]


def test_kinects_on_one_bus_do_not_fit_even_where_only_their_driver_shows_it(tmp_path: Path) -> None:
    listed = [PluggedDevice("kinect", "Kinect 1414", serial, bus=2) for serial in ("A1", "B2")]
    found = look(tmp_path, MadeDriver("kinect", listed))
    assert [(one.code, one.values["controller"]) for one in found.problems] == [("buses_full", "bus 2")]


@pytest.mark.usefixtures("no_leaked_threads")
def test_sensors_have_the_names_that_people_gave(tmp_path: Path) -> None:
    drivers = [kinects("A1", "B2", "C3")]
    known_as = {"B2": "left", "C3": "kinect_1", "away": "kinect_2"}
    found = check_up(CheckupPlan(SECONDS, Machine(tmp_path), drivers, known_as=known_as))
    assert [(one.serial, one.name) for one in found.sensors] == [("A1", "kinect_3"), ("B2", "left"), ("C3", "kinect_1")]
    assert all(one.measured is not None for one in found.sensors)


def test_sensors_that_cannot_be_told_apart_are_said_and_not_run(tmp_path: Path) -> None:
    driver = MadeDriver("kinect", [PluggedDevice("kinect", "Kinect 1473", "0000000000000000")] * 2)
    found = look(tmp_path, driver, seconds=SECONDS)
    assert [(one.state, codes(one)) for one in found.sensors] == [(SensorState.FAILED, ["no_serial"])] * 2
    assert driver.sensors["0000000000000000"].opened == 0


def test_a_sensor_that_may_not_be_asked_for_its_serial_is_closed(tmp_path: Path) -> None:
    driver = MadeDriver("kinect", [PluggedDevice("kinect", "Kinect 1414", "", limits=("Not allowed.",), bus=1)])
    (unseen,) = look(tmp_path / "nowhere", driver).sensors
    assert (unseen.state, codes(unseen)) == (SensorState.FAILED, ["closed"])
    system = made_system(tmp_path)
    system.closed.add(system.kinect("1-1", "A1"))
    (seen,) = look(system, driver, seconds=SECONDS).sensors
    assert (seen.state, codes(seen)) == (SensorState.NO_ACCESS, ["no_access"])
    assert driver.sensors[""].opened == 0


@pytest.mark.parametrize(("vendor", "product", "make"), [(0x045E, 0x02D8, "kinect_v2"), (0x1D27, 0x0601, "primesense")])
def test_a_sensor_without_a_driver_is_said(tmp_path: Path, vendor: int, product: int, make: str) -> None:
    system = made_system(tmp_path)
    system.plug("2-1", vendor, product, speed=5000)
    (sensor,) = look(system, kinects()).sensors
    assert (sensor.name, sensor.state, codes(sensor)) == (f"{make}_1", SensorState.NO_DRIVER, ["unsupported"])


def test_a_library_that_is_missing_is_said_beside_its_sensor(tmp_path: Path) -> None:
    system = made_system(tmp_path)
    system.kinect("1-1", "A1")
    driver = kinects()
    driver.missing = WorldError("driver_missing", "libfreenect is not installed.", "apt install libfreenect0.5")
    (sensor,) = look(system, driver).sensors
    assert (sensor.state, codes(sensor)) == (SensorState.NO_DRIVER, ["driver_missing"])
    assert sensor.problems[0].remedy == "apt install libfreenect0.5"
    empty = look(tmp_path / "empty", driver)
    assert [one.code for one in empty.problems] == ["no_usb", "driver_missing"]


@pytest.mark.parametrize(
    ("closed", "state", "expected"),
    [(True, SensorState.NO_ACCESS, ["no_access"]), (False, SensorState.FAILED, ["not_found"])],
)
def test_a_sensor_that_its_driver_does_not_list_has_a_reason(
    tmp_path: Path, closed: bool, state: SensorState, expected: list[str]
) -> None:
    system = made_system(tmp_path)
    camera = system.kinect("1-1", "A1")
    system.closed |= {camera} if closed else set()
    (sensor,) = look(system, kinects(), seconds=SECONDS).sensors
    assert (sensor.state, codes(sensor)) == (state, expected)


def test_a_vendors_driver_is_asked_only_where_the_usb_shows_its_device(tmp_path: Path) -> None:
    system = made_system(tmp_path)
    drivers = [MadeDriver("realsense"), MadeDriver("oak"), kinects()]
    system.plug("2-1", 0x8086, 0x0B07, speed=5000)
    look(system, *drivers)
    assert [one.asked for one in drivers] == [1, 0, 1]


# measured


@pytest.mark.usefixtures("no_leaked_threads")
def test_two_kinects_that_run_well_on_one_controller_are_only_to_be_watched(tmp_path: Path) -> None:
    listed = [PluggedDevice("kinect", "Kinect 1414", serial, bus=2) for serial in ("A1", "B2")]
    driver = MadeDriver("kinect", listed)
    for sensor in driver.sensors.values():
        sensor._promised_hz = 1.0
    assert [one.code for one in look(tmp_path, driver, seconds=SECONDS).problems] == ["bus_tight"]
    driver.sensors["B2"].lose = 1
    assert [one.code for one in look(tmp_path, driver, seconds=SECONDS).problems] == ["buses_full"]


@pytest.mark.usefixtures("no_leaked_threads")
def test_what_a_driver_says_when_it_cannot_open_is_the_state(tmp_path: Path) -> None:
    driver = kinects("A1", "B2", "C3")
    told = {"A1": "sensor_busy", "B2": "sensor_not_allowed", "C3": "usb_full"}
    for serial, code in told.items():
        driver.sensors[serial].error = WorldError(code, "It is so.", "Change it.")
    found = look(tmp_path, driver, seconds=SECONDS)
    states = [SensorState.BUSY, SensorState.NO_ACCESS, SensorState.FAILED]
    assert [(one.state, codes(one)) for one in found.sensors] == [
        (state, [code]) for state, code in zip(states, told.values(), strict=True)
    ]


@pytest.mark.usefixtures("no_leaked_threads")
def test_rate_and_loss_are_measured_with_all_running_at_once(tmp_path: Path) -> None:
    driver = kinects("A1", "B2")
    driver.sensors["B2"].lose = 1
    first, second = look(tmp_path, driver, seconds=SECONDS).sensors
    assert first.measured is not None
    assert second.measured is not None
    # 50 a second at most; a machine that is busy gives fewer, but frames and time are counted over the same moments.
    assert 0.0 < first.measured.rate_hz <= 55.0
    assert first.measured.lost == 0
    assert abs(second.measured.lost - second.measured.frames) <= 2
    assert [one.opened for one in driver.sensors.values()] == [1, 1]
    assert all(one.closed for one in driver.sensors.values())


@pytest.mark.parametrize(("held_s", "code"), [(math.inf, "loses"), (0.0, "loses_busy")])
@pytest.mark.usefixtures("no_leaked_threads")
def test_pictures_that_are_lost_are_the_computers_where_it_is_later_than_the_usb_holds_them(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, held_s: float, code: str
) -> None:
    """How late this computer is, no test can tell: a USB that holds them for ever, or not at all, decides."""
    monkeypatch.setattr(measuring, "HELD_S", held_s)
    driver = kinects("A1")
    driver.sensors["A1"].lose = 1
    (sensor,) = look(tmp_path, driver, seconds=SECONDS).sensors
    assert [one for one in codes(sensor) if one != "slow"] == [code]  # as it is where this computer has no time


@pytest.mark.usefixtures("no_leaked_threads")
def test_a_slow_sensor_is_said(tmp_path: Path) -> None:
    driver = kinects("A1")
    driver.sensors["A1"]._promised_hz = 1000.0
    (sensor,) = look(tmp_path, driver, seconds=SECONDS).sensors
    assert sensor.state is SensorState.RUNNING
    assert codes(sensor) == ["slow"]


@pytest.mark.usefixtures("no_leaked_threads")
def test_a_sensor_that_cannot_be_opened_says_why_and_the_others_run(tmp_path: Path) -> None:
    driver = kinects("A1", "B2", "C3")
    driver.sensors["A1"].error = WorldError("broken", "It is broken.", "Mend it.")
    driver.sensors["B2"].error = ZeroDivisionError("a bug")
    first, second, third = look(tmp_path, driver, seconds=SECONDS).sensors
    assert (first.state, codes(first)) == (SensorState.FAILED, ["broken"])
    assert (second.state, codes(second)) == (SensorState.FAILED, ["sensor_failed"])
    assert third.state is SensorState.RUNNING


@pytest.mark.usefixtures("no_leaked_threads")
def test_a_sensor_that_another_program_holds_is_named_only_where_that_is_in_the_way(tmp_path: Path) -> None:
    system = made_system(tmp_path)
    system.controller("0000:05:00.0", 3)
    system.run(17, "cheese", system.kinect("1-1", "A1"), system.kinect("3-1", "B2"))
    driver = kinects("A1", "B2")
    driver.sensors["A1"].error = WorldError("sensor_failed", "It cannot be opened.", "Plug it in again.")
    unmeasured = look(system, driver)
    assert [(one.state, codes(one)) for one in unmeasured.sensors] == [(SensorState.BUSY, ["busy"])] * 2
    first, second = look(system, driver, seconds=SECONDS).sensors
    assert (first.state, codes(first)) == (SensorState.BUSY, ["busy"])
    assert (second.state, codes(second)) == (SensorState.RUNNING, [])


@pytest.mark.usefixtures("no_leaked_threads")
def test_a_silent_sensor_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("fruitgui.station.checkup.measuring.START_S", 0.1)
    driver = kinects("A1")
    driver.sensors["A1"].silent = True
    (sensor,) = look(tmp_path, driver, seconds=0.1).sensors
    assert (sensor.state, codes(sensor)) == (SensorState.SILENT, ["silent"])
    assert sensor.measured is None


@pytest.mark.usefixtures("no_leaked_threads")
@pytest.mark.parametrize(
    ("then", "state", "problems"),
    [
        (WorldError("sensor_gone", "It is gone.", "Plug it in."), SensorState.FAILED, ["sensor_gone"]),
        (None, SensorState.SILENT, ["fell_silent"]),
    ],
)
def test_a_sensor_that_stops_while_it_is_watched_is_said(
    tmp_path: Path, then: WorldError | None, state: SensorState, problems: list[str]
) -> None:
    driver = kinects("A1")
    sensor = driver.sensors["A1"]
    sensor.last = then

    def stop_at_a_third(share: float, _doing: str) -> None:
        if share > 0.55:
            sensor.over.set()

    (checked,) = check_up(CheckupPlan(2.5, Machine(tmp_path), [driver]), stop_at_a_third).sensors
    assert (checked.state, codes(checked)[:1]) == (state, problems)
    assert checked.measured is not None
    assert checked.measured.frames > 0


def test_a_driver_that_hangs_when_opened_is_left_behind(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("fruitgui.station.checkup.measuring.START_S", 3.0)
    driver = kinects("A1", "B2")
    stuck = driver.sensors["A1"]
    stuck.hangs.set()
    try:
        first, second = look(tmp_path, driver, seconds=SECONDS).sensors
    finally:
        stuck.let_go.set()
    assert (first.state, codes(first)) == (SensorState.HANGS, ["hangs"])
    assert second.state is SensorState.RUNNING


def test_a_driver_that_does_not_answer_is_left_behind_and_the_others_are_asked(tmp_path: Path) -> None:
    system = made_system(tmp_path)
    system.kinect("1-1", "A1")
    system.plug("2-1", 0x8086, 0x0B07, speed=5000, serial="R1")
    let_go = threading.Event()
    stuck = MadeDriver("kinect", before=lambda: let_go.wait(60.0) and None)
    other = MadeDriver("realsense", [PluggedDevice("realsense", "RealSense D435", "R1")])
    try:
        found = look(system, stuck, other, answer_s=4.0)
    finally:
        let_go.set()
    assert [one.code for one in found.problems] == ["driver_hangs"]
    assert [(one.name, one.state) for one in found.sensors] == [
        ("realsense_1", SensorState.READY),
        ("kinect_1", SensorState.HANGS),
    ]


def test_a_driver_whose_bus_is_slow_is_asked_until_it_has_looked(tmp_path: Path) -> None:
    driver = kinects("A1")
    driver.slow_looks = 2
    assert [one.serial for one in look(tmp_path, driver).sensors] == ["A1"]


def test_a_driver_with_a_bug_is_said_and_the_others_are_asked(tmp_path: Path) -> None:
    def bug() -> None:
        raise KeyError("bug")

    system = made_system(tmp_path)
    system.plug("2-1", 0x8086, 0x0B07, speed=5000, serial="R1")
    found = look(system, MadeDriver("realsense", before=bug), kinects("A1"))
    assert [(one.code, one.values["make"]) for one in found.problems] == [("driver_failed", "realsense")]
    assert [(one.name, one.state) for one in found.sensors] == [
        ("kinect_1", SensorState.READY),
        ("realsense_1", SensorState.FAILED),
    ]


@pytest.mark.usefixtures("no_leaked_threads")
def test_it_can_be_cancelled_and_leaves_nothing_running(tmp_path: Path) -> None:
    driver = kinects("A1")
    began_s = time.monotonic()
    with pytest.raises(CancelledByUserError):
        check_up(
            CheckupPlan(600.0, Machine(tmp_path), [driver]), no_progress, lambda: driver.sensors["A1"]._sequence > 3
        )
    assert time.monotonic() - began_s < 60.0
    assert driver.sensors["A1"].closed


def test_progress_only_grows(tmp_path: Path) -> None:
    shares: list[float] = []
    plan = CheckupPlan(SECONDS, Machine(tmp_path), [kinects("A1")])
    check_up(plan, lambda share, _doing: shares.append(share), never_cancelled)
    assert shares == sorted(shares)
    assert shares[-1] == 1.0


def test_every_problem_has_words_that_can_be_filled() -> None:
    for code, (what, remedy) in WORDS.items():
        values = dict.fromkeys(_names(what) | _names(remedy), "x")
        said = problem(code, **values)
        assert said.what.endswith((".", ")."))
        assert said.remedy


def _names(text: str) -> set[str]:
    import string

    return {name for _, name, _, _ in string.Formatter().parse(text) if name}


def test_neither_open3d_nor_a_vendors_library_is_loaded() -> None:
    script = (
        "import sys; from fruitgui.cli import main; main(['sensors', '--json']);"
        "print(sorted({'open3d', 'pyrealsense2', 'pyorbbecsdk', 'depthai', 'PySide6', 'sklearn', 'rosbags'}"
        " & set(sys.modules)), file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stderr.strip().splitlines()[-1] == "[]"
    json.loads(done.stdout)
