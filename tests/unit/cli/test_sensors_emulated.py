"""`fruitgui sensors` with the real libfreenect on Kinects of an emulated USB bus: found, run, told what is wrong."""

from __future__ import annotations

import ctypes
import io
import json
import math
import sys
import threading
import time
from collections.abc import Callable
from contextlib import redirect_stdout
from pathlib import Path
from typing import Any

import pytest

from fruitgui.station.checkup import measuring
from tests.emulated_usb.emulation import MODEL_1473, Emulation, Hang, Kinect
from tests.emulated_usb.outside import alone, inside, run_command
from tests.emulated_usb.player import Player

pytestmark = alone

WATCHED_S = (1, 5, 20)
"""On a computer that has no time for its sensors a short look sees none of them run: then they are watched longer."""

HEAVY = ("open3d", "pyrealsense2", "pyorbbecsdk", "depthai", "PySide6")


def sensors(*arguments: str) -> dict[str, Any]:
    """Return what the command prints."""
    from fruitgui.cli import main

    out = io.StringIO()
    with redirect_stdout(out):
        assert main(["sensors", "--json", *arguments]) == 0
    assert [name for name in HEAVY if name in sys.modules] == []
    value: dict[str, Any] = json.loads(out.getvalue())
    return value


def found(usb: Emulation, holds: Callable[[dict[str, Any]], bool]) -> dict[str, Any]:
    """Return what the command prints of Kinects that stream, once it holds; or what it printed last."""
    with Player(usb):
        for seconds in WATCHED_S:
            value = sensors("--seconds", str(seconds))
            if holds(value):
                break
    return value


def states(value: dict[str, Any]) -> list[str]:
    """Return the state of each sensor."""
    return [one["state"] for one in value["sensors"]]


def codes(value: dict[str, Any]) -> list[tuple[str, list[str]]]:
    """Return state and problems of each sensor."""
    return [(one["state"], [each["code"] for each in one["problems"]]) for one in value["sensors"]]


@inside
def test_kinects_are_listed_with_their_rates(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1", bus=1), Kinect("B2", bus=2, model=MODEL_1473))
    value = found(usb, lambda one: states(one) == ["running", "running"] and not one["problems"])
    first, second = value["sensors"]
    assert [(one["id"], one["make"], one["model"], one["serial"]) for one in (first, second)] == [
        ("kinect_1", "kinect", "Kinect 1414", "A1"),
        ("kinect_2", "kinect", "Kinect 1473", "B2"),
    ]
    for one in (first, second):
        assert one["state"] == "running"
        assert 0.0 < one["rate_hz"]["color"] == one["rate_hz"]["depth"] < 40.0
        assert one["lost_frames"] >= 0
    assert (first["usb"]["bus"], second["usb"]["bus"]) == (1, 2)
    assert first["limits"] == []
    assert second["limits"] != []
    assert value["problems"] == []


def test_the_command_as_a_process_finds_them() -> None:
    script = {"kinects": [{"serial": "A1", "bus": 1}, {"serial": "B2", "bus": 2}]}
    done = run_command(script, "sensors", "--json", "--seconds", "1")
    assert done.returncode == 0, done.stderr
    assert [one["serial"] for one in json.loads(done.stdout)["sensors"]] == ["A1", "B2"]


@inside
def test_without_being_run_they_are_ready_and_full_buses_are_said(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1", bus=1), Kinect("B2", bus=1), Kinect("C3", bus=2))
    value = sensors("--seconds", "0")
    assert codes(value) == [("ready", [])] * 3
    (full,) = value["problems"]
    assert full["code"] == "buses_full"
    assert "kinect_1, kinect_2" in full["what"]


@inside
def test_an_empty_bus_is_no_failure(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in()
    value = sensors()
    assert value["sensors"] == []
    assert len(value["problems"]) == 1


@inside
def test_one_that_may_not_be_opened_is_said_and_the_other_runs(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"), Kinect("B2"))
    usb.denied(0, on=True)
    value = found(usb, lambda one: states(one) == ["failed", "running"])
    assert codes(value)[0] == ("failed", ["closed"])
    assert "--install-udev-rules" in value["sensors"][0]["problems"][0]["remedy"]
    assert value["sensors"][1]["state"] == "running"


@inside
def test_one_that_another_program_uses_is_said(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"))
    usb.busy(0, on=True)
    assert codes(found(usb, lambda one: states(one) == ["busy"])) == [("busy", ["sensor_busy"])]


@inside
def test_a_controller_without_room_is_said(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"))
    usb.no_bandwidth(0, on=True)
    assert codes(found(usb, lambda one: states(one) == ["failed"])) == [("failed", ["usb_full"])]


@inside
def test_one_that_loses_packets_is_said(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"), Kinect("B2"))
    usb.lose_every(1, 400)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(measuring, "HELD_S", math.inf)  # however busy this computer is, it took in time what came
        value = found(usb, lambda one: "loses" in codes(one)[1][1])
    assert "loses" in codes(value)[1][1]
    assert value["sensors"][1]["lost_frames"] > 0


@inside
def test_a_computer_without_time_is_named_beside_the_cable(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"))
    usb.lose_every(0, 400)
    over = threading.Event()
    holding = threading.Thread(target=_hold_everybody_up, args=(over,))
    holding.start()
    try:
        value = found(usb, lambda one: "loses_busy" in codes(one)[0][1])
    finally:
        over.set()
        holding.join(60.0)
    (one,) = value["sensors"][0]["problems"][-1:]
    assert one["code"] == "loses_busy"
    assert "cable" in one["remedy"]
    assert "other programs" in one["remedy"]


@inside
def test_one_without_a_serial_is_run_by_being_the_only_one(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    for none in (Kinect(""), Kinect("", model=MODEL_1473)):
        usb.plug_in(none)
        value = found(usb, lambda one: states(one) == ["running"])
        assert states(value) == ["running"]
        assert "no_serial_alone" in codes(value)[0][1]
        assert value["sensors"][0]["rate_hz"]["depth"] > 0.0
    usb.plug_in(Kinect(""), Kinect("B2"))
    assert codes(sensors("--seconds", "0.5"))[0] == ("failed", ["no_serial"])


@inside
def test_a_webcam_driver_that_does_not_let_go_is_named_with_its_remedy(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"))
    usb.kernel_driver(0, on=True, stays=True)
    value = found(usb, lambda one: states(one) == ["busy"])
    assert codes(value) == [("busy", ["sensor_held"])]
    assert "modprobe -r gspca_kinect" in value["sensors"][0]["problems"][0]["remedy"]


@inside
def test_one_that_two_others_look_like_is_not_run(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"), Kinect("A1"))
    assert codes(sensors("--seconds", "0.5")) == [("failed", ["no_serial"])] * 2


@inside
def test_one_that_is_unplugged_meanwhile_is_said(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"))
    unplugging = threading.Thread(target=_when, args=(lambda: usb.shines(0), lambda: usb.plug(0, on=False)))
    unplugging.start()
    value = found(usb, lambda one: states(one) != ["running"])
    unplugging.join(60.0)
    assert states(value) != ["running"]
    assert all(problems for _, problems in codes(value))
    assert value["sensors"] or value["problems"]


@inside
def test_a_kinect_that_hangs_does_not_hang_the_command(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"), Kinect("B2"))
    hanging = threading.Thread(target=_when, args=(lambda: usb.shines(0), lambda: usb.hang(0, Hang.CONTROL)))
    hanging.start()
    try:
        value = found(usb, lambda one: states(one) == ["hangs", "running"])
    finally:
        hanging.join(60.0)
        usb.hang(0, Hang.NOTHING)
    assert codes(value)[0] == ("hangs", ["hangs"])
    assert value["sensors"][1]["state"] == "running"


def _hold_everybody_up(over: threading.Event) -> None:
    """Let nothing of this process run for most of the time."""
    holding = ctypes.PyDLL(None).usleep  # keeps Python's lock
    while not over.wait(0.02):
        holding(80_000)


def _when(true: Callable[[], bool], then: Callable[[], None]) -> None:
    end_s = time.monotonic() + 60.0
    while not true() and time.monotonic() < end_s:
        time.sleep(0.005)
    then()
