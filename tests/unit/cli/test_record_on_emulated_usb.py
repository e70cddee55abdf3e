"""`fruitgui record` where Kinects are plugged in that cannot be used: a made-up rig is no answer to that."""

from __future__ import annotations

import contextlib
import io
import json
from collections.abc import Callable
from pathlib import Path

from fruitgui.cli import main
from fruitgui.station.devices import connected_devices, unusable_devices
from tests.emulated_usb.emulation import Emulation, Hang, Kinect
from tests.emulated_usb.outside import inside


@inside
def test_a_kinect_that_cannot_be_used_is_an_error_and_no_simulation(usb: Emulation, tmp_path: Path) -> None:
    usb.plug_in(Kinect("A1"))
    for trouble, words in ((usb.denied, "--install-udev-rules"), (_hang(usb), "Unplug")):
        trouble(0, True)
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            code = main(["record", "--out", str(tmp_path / "r.mcap"), "--seconds", "1", "--json"])
        error = json.loads(out.getvalue())["error"]
        assert (code, error["code"]) == (1, "no_usable_sensor")
        assert words in error["remedy"]
        assert not list(tmp_path.glob("*.mcap"))
        trouble(0, False)


@inside
def test_one_that_does_not_answer_hides_no_other(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"), Kinect("B2"))
    usb.hang(0, Hang.CONTROL)
    assert [sensor.info.serial for sensor in connected_devices({})] == ["B2"]
    assert [(model, why.code) for model, why in unusable_devices()] == [("Kinect 1414", "hangs")]
    usb.hang(0, Hang.NOTHING)


def _hang(usb: Emulation) -> Callable[[int, bool], None]:
    return lambda number, on: usb.hang(number, Hang.CONTROL if on else Hang.NOTHING)
