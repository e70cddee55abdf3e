"""`fruitgui sensors` through main(): for people and for programs, with and without sensors."""

from __future__ import annotations

import io
import json
import os
import pty
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from fruitgui.cli import main, projectors
from fruitgui.sensors.usb.udev import rules_file
from fruitgui.simulation.projector import projector_models
from fruitgui.simulation.supply import LineOptions
from fruitgui.station import projector_job
from fruitgui.station.checkup import job
from fruitgui.station.projector_job import try_devices
from fruitgui.station.projectors import Projectors
from fruitgui.station.written import read_written
from tests.unit.sensors.lit_room import LitRoom, LitSensor
from tests.unit.sensors.made_system import made_system
from tests.unit.simulation.true_light import TrueLight
from tests.unit.station.made_drivers import MadeDriver, kinects


def plugged(monkeypatch: pytest.MonkeyPatch, *drivers: MadeDriver) -> None:
    plan = job.CheckupPlan
    monkeypatch.setattr(job, "CheckupPlan", lambda seconds, machine: plan(seconds, machine, drivers))


def printed(capsys: pytest.CaptureFixture[str], *arguments: object) -> str:
    assert main([str(one) for one in arguments]) == 0
    return capsys.readouterr().out


def test_programs_get_one_object(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    system = made_system(tmp_path)
    system.kinect("1-1", "A1")
    plugged(monkeypatch, kinects("A1"))
    value = json.loads(printed(capsys, "sensors", "--json", "--seconds", "0.3", "--root", tmp_path))
    (sensor,) = value["sensors"]
    assert (sensor["id"], sensor["make"], sensor["serial"], sensor["state"]) == ("kinect_1", "kinect", "A1", "running")
    assert sensor["rate_hz"]["color"] == sensor["rate_hz"]["depth"] > 0.0
    assert sensor["usb"]["controller"] == "0000:00:14.0"
    assert value["problems"] == []


def test_people_get_a_table_and_what_to_do(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    system = made_system(tmp_path)
    system.kinect("1-1", "A1")
    system.kinect("1-2", "B2")
    plugged(monkeypatch, kinects("A1"))
    text = printed(capsys, "sensors", "--seconds", "0", "--root", tmp_path)
    lines = text.splitlines()
    assert lines[0].split() == ["Sensor", "Model", "Serial", "USB", "State", "Pictures/s", "Lost"]
    assert lines[1].split()[:4] == ["kinect_1", "Kinect", "1414", "A1"]
    assert "kinect_1, kinect_2" in text
    assert "146 %" in text
    assert "0000:00:14.0" in text
    assert "it has room for one Kinect" in " ".join(text.split())  # lines break where the terminal ends
    assert "add a USB card" in " ".join(text.split())


@pytest.mark.parametrize("encoding", ["ascii", "latin-1", "utf-8"])
def test_any_terminal_shows_any_name(encoding: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    system = made_system(tmp_path)
    system.plug("1-1", 0x2BC5, 0x0403, name="Astra 深度 [bold]é", serial="[/]")
    plugged(monkeypatch)
    out = io.TextIOWrapper(io.BytesIO(), encoding=encoding, errors="backslashreplace")
    monkeypatch.setattr(sys, "stdout", out)
    assert main(["sensors", "--seconds", "0", "--root", str(tmp_path)]) == 0
    out.flush()
    raw = out.buffer
    assert isinstance(raw, io.BytesIO)
    text = raw.getvalue().decode(encoding)
    assert "[bold]" in text
    assert "[/]" in text


def test_nothing_connected_is_no_failure_and_says_what_to_check(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    made_system(tmp_path)
    plugged(monkeypatch, kinects())
    text = printed(capsys, "sensors", "--root", tmp_path)
    assert "No depth sensor was found" in text
    assert "power supply" in text
    value = json.loads(printed(capsys, "sensors", "--json", "--root", tmp_path))
    assert value["sensors"] == []
    assert [one["code"] for one in value["problems"]] == ["nothing_connected"]


@pytest.mark.parametrize(
    "arguments",
    [
        ["--seconds", "-1"],
        ["--seconds", "nan"],
        ["--seconds", "long"],
        ["--seconds", "1e9"],
        ["--root", "no/such/folder"],
        ["--install-udev-rules"],
        ["kinect_1"],
    ],
)
def test_bad_usage_ends_with_2(
    arguments: list[str], capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    made_system(tmp_path)
    monkeypatch.setattr(sys, "stdin", io.StringIO("y\n"))
    given = arguments if "--root" in arguments else [*arguments, "--root", str(tmp_path)]
    assert main(["sensors", "--json", *given]) == 2
    error = json.loads(capsys.readouterr().out)["error"]
    assert error["code"] == "usage"
    assert error["remedy"]
    assert not (tmp_path / "etc/udev/rules.d").exists()


# the rules


def _rules(root: Path) -> Path:
    return root / "etc/udev/rules.d/60-fruitgui.rules"


def test_with_yes_the_rules_are_installed_once(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    made_system(tmp_path)
    asked = ("sensors", "--install-udev-rules", "--yes", "--json", "--root", tmp_path)
    assert json.loads(printed(capsys, *asked)) == {"rules": str(_rules(tmp_path)), "changed": True}
    assert _rules(tmp_path).read_bytes() == rules_file().read_bytes()
    assert json.loads(printed(capsys, *asked))["changed"] is False


class _Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


@pytest.mark.parametrize(
    ("answer", "code"), [("y\n", 0), (" YES \n", 0), ("n\n", 130), ("\n", 130), ("", 130), ("ye\n", 130), ("j\n", 130)]
)
def test_nothing_is_written_before_a_yes(
    answer: str, code: int, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    made_system(tmp_path)
    monkeypatch.setattr(sys, "stdin", _Terminal(answer))
    assert main(["sensors", "--install-udev-rules", "--root", str(tmp_path)]) == code
    asked = capsys.readouterr().err
    assert str(_rules(tmp_path)) in asked
    assert 'ATTR{idVendor}=="045e"' in asked, "what will be written is shown before"
    assert "[y/N]" in asked
    assert _rules(tmp_path).exists() == (code == 0)


def test_without_udev_it_fails_and_says_so(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert main(["sensors", "--install-udev-rules", "--yes", "--root", str(tmp_path)]) == 1
    assert "no udev" in capsys.readouterr().err


# as a process

HUNG = """
import sys, threading
from pathlib import Path
from fruitgui.sensors import drivers
from tests.unit.station.made_drivers import kinects

driver = kinects("A1")
driver.sensors["A1"].start = lambda: print("runs", file=sys.stderr, flush=True)
if sys.argv[1] == "opening":
    driver.sensors["A1"].hangs.set()
elif sys.argv[1] == "asking":
    driver._before = threading.Event().wait
from fruitgui.station.checkup import asking, job, measuring
asking.ANSWER_S = measuring.START_S = 0.5
plan = job.CheckupPlan
job.CheckupPlan = lambda seconds, machine: plan(seconds, machine, [driver], answer_s=0.5)
from fruitgui.__main__ import main
sys.argv[1:] = ["sensors", "--json", "--seconds", sys.argv[2]]
sys.exit(main())
"""


def started(*arguments: str) -> subprocess.Popen[str]:
    return subprocess.Popen([sys.executable, "-c", HUNG, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                            text=True, cwd=Path(__file__).parents[3])  # fmt: skip


@pytest.mark.parametrize(("where", "state"), [("opening", "hangs"), ("asking", None)])
def test_a_driver_that_hangs_does_not_hang_the_command(where: str, state: str | None) -> None:
    with started(where, "0.2") as process:
        out, err = process.communicate(timeout=120)
    assert process.returncode == 0, err
    value = json.loads(out)
    assert [one["state"] for one in value["sensors"]] == ([] if state is None else [state])
    assert ("driver_hangs" in [one["code"] for one in value["problems"]]) == (state is None)


def test_an_interrupt_while_sensors_run_ends_with_130_and_one_object() -> None:
    with started("running", "600") as process:
        assert process.stderr is not None
        assert process.stderr.readline() == "runs\n"
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=120)
    assert process.returncode == 130, err
    assert json.loads(out)["error"]["code"] == "cancelled"
    assert "Traceback" not in err


def test_on_a_terminal_it_shows_how_far_it_is_and_leaves_nothing_of_that() -> None:
    ours, theirs = pty.openpty()
    with subprocess.Popen([sys.executable, "-m", "fruitgui", "sensors", "--seconds", "0"], stdout=subprocess.PIPE,
                          stderr=theirs, text=True) as process:  # fmt: skip
        out, _ = process.communicate(timeout=120)
    os.close(theirs)
    said = os.read(ours, 65536).decode()
    os.close(ours)
    assert process.returncode == 0
    assert "Looking at the USB" in said
    assert said.endswith("\r\x1b[K")
    assert "Looking" not in out


def test_projectors_are_measured_said_and_kept(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    room = LitRoom()
    monkeypatch.setattr(projector_job, "TRIALS", 3)
    monkeypatch.setattr(
        projectors, "connected_devices", lambda _names: [LitSensor(f"kinect_{one}", room) for one in (1, 2)]
    )
    value = json.loads(printed(capsys, "sensors", "--json", "--projectors", "--line", tmp_path / "line"))
    assert set(value["projectors"]) == {"kinect_1", "kinect_2"}
    assert all(0.0 <= one["settle_s"] < 0.3 for one in value["projectors"].values())
    assert [one["harm"] for one in value["pairs"]] == [["much", "much"]]
    kept = read_written(Path(value["kept"]), Projectors)
    assert set(kept.settlings) == {"S-kinect_1", "S-kinect_2"}
    text = printed(capsys, "sensors", "--projectors", "--line", tmp_path / "line")
    assert "kinect_1: steady after" in text
    assert "kinect_2 beside kinect_1: without depth 5.0 → 15.0 %" in text


def test_projectors_of_a_simulated_rig_are_found_as_they_are(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    rig = LineOptions(rig_seed=2, layout="disconnected", sensors=3, rate_hz=20.0, settling_s=0.3)
    monkeypatch.setattr(projectors, "PRESETS", {projectors.SIMULATED: rig})
    for name, value in (("TRIALS", 3), ("VIEWS", 20), ("TOGETHER", 10)):
        monkeypatch.setattr(projector_job, name, value)
    light, found = TrueLight(monkeypatch), []
    monkeypatch.setattr(projectors, "try_devices", lambda *given: found.append(try_devices(*given)) or found[0])
    told = json.loads(printed(capsys, "sensors", "--json", "--projectors", "--simulated", "--line", tmp_path / "line"))
    devices = rig.setting().devices
    models = projector_models(2, [device.sensor for device in devices], 0.3)
    for sensor, model in models.items():
        light.check(sensor, model.settle_s, found[0].alone[sensor])
        assert told["projectors"][sensor]["settle_s"] == found[0].alone[sensor].settle_s
    assert {tuple(one["sensors"]): one["harm"] for one in told["pairs"]} == {
        ("kinect_1", "kinect_2"): ["much", "much"],
        ("kinect_1", "kinect_3"): ["none", "none"],
        ("kinect_2", "kinect_3"): ["none", "none"],
    }
    kept = read_written(Path(told["kept"]), Projectors)
    assert set(kept.settlings) == {device.serial for device in devices}
    (pair,) = (one.serials for one in kept.interferences if one.disturbs)
    assert set(pair) == {devices[0].serial, devices[1].serial}


def test_simulated_alone_says_what_is_missing(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["sensors", "--simulated"]) == 2
    assert "--projectors" in capsys.readouterr().err


def test_without_sensors_there_are_no_projectors_to_measure(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(projectors, "connected_devices", lambda _names: [])
    assert main(["sensors", "--projectors", "--line", str(tmp_path / "line")]) == 2
    assert "Plug them in" in capsys.readouterr().err
    assert not (tmp_path / "line").exists()
