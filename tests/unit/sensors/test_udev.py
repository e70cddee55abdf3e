"""The rules that let people use sensors: they name every sensor that is known, and get in whole or not at all."""

from __future__ import annotations

import fnmatch
import os
import re
import stat
from functools import cache
from pathlib import Path

import pytest

from fruitgui.errors import WorldError
from fruitgui.sensors.usb import udev
from fruitgui.sensors.usb.known import known_device
from fruitgui.sensors.usb.machine import Machine
from fruitgui.sensors.usb.tree import UsbDevice
from fruitgui.sensors.usb.udev import install_rules, rules_are_installed, rules_file, rules_install, rules_target
from tests.unit.sensors.made_system import MadeSystem

TERM = re.compile(r'(\w+(?:\{\w+\})?)(==|=)"([^"]*)"')


@cache
def rules() -> list[dict[str, str]]:
    """What each rule compares and sets, for USB devices."""
    lines = rules_file().read_text(encoding="utf-8").splitlines()
    terms = [TERM.findall(line) for line in lines if not line.startswith("#")]
    return [{key + sign: value for key, sign, value in found} for found in terms if found]


def opened(vendor: int, product: int) -> bool:
    """Whether the rules let everybody use a USB device, read as udev reads them."""
    facts = {"SUBSYSTEM==": "usb", "ENV{DEVTYPE}==": "usb_device", "ATTR{idVendor}==": f"{vendor:04x}"}
    facts["ATTR{idProduct}=="] = f"{product:04x}"
    return any(
        rule["MODE="] == "0666"
        and all(
            any(fnmatch.fnmatchcase(facts.get(key, "-"), one) for one in value.split("|"))
            for key, value in rule.items()
            if key.endswith("==")
        )
        for rule in rules()
    )


def test_every_line_is_a_rule_or_a_comment() -> None:
    for line in filter(None, rules_file().read_text(encoding="utf-8").splitlines()):
        rest = TERM.sub("", line).replace(",", "").strip()
        assert line.startswith("#") or rest == "", line


@pytest.mark.parametrize(("vendor", "step"), [(0x045E, 1), (0x8086, 1), (0x03E7, 1), (0x1D27, 251), (0x2BC5, 251)])
def test_every_device_that_is_known_is_opened(vendor: int, step: int) -> None:
    known = [
        number for number in range(0, 0x10000, step) if known_device(UsbDevice(1, 2, (1,), vendor, number)) is not None
    ]
    assert known
    assert [f"{number:04x}" for number in known if not opened(vendor, number)] == []


def test_nothing_else_is_opened() -> None:
    assert not opened(0x046D, 0xC52B)  # a mouse
    assert not opened(0x045E, 0x0040)  # another one, of the Kinect's maker
    assert not opened(0x8086, 0x0001)


def test_installing_writes_the_rules_readable_for_all_and_again_changes_nothing(tmp_path: Path) -> None:
    machine = MadeSystem(tmp_path).machine
    assert not rules_are_installed(machine)
    install = rules_install(machine, "sudo")
    assert install.command == ()
    assert str(install.target) in install.shown()
    install_rules(install)
    assert rules_are_installed(machine)
    target = rules_target(machine)
    assert target.read_bytes() == rules_file().read_bytes()
    assert stat.S_IMODE(target.stat().st_mode) == 0o644
    assert [one.name for one in target.parent.iterdir()] == ["60-fruitgui.rules"]
    install_rules(install)
    assert rules_are_installed(machine)


def test_a_system_without_udev_is_said(tmp_path: Path) -> None:
    with pytest.raises(WorldError, match="no udev"):
        rules_install(Machine(tmp_path), "sudo")


def test_rules_that_cannot_be_written_are_said_and_nothing_is_left(tmp_path: Path) -> None:
    machine = MadeSystem(tmp_path).machine
    install = rules_install(machine, "sudo")
    rules_target(machine).parent.write_text("a file in the way")
    with pytest.raises(WorldError):
        install_rules(install)
    assert [one.name for one in (tmp_path / "etc/udev").iterdir()] == ["rules.d"]


@pytest.fixture
def as_a_person(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Let the system be a made one that a person may not change, with a `sudo` that a test writes; return its place."""
    MadeSystem(tmp_path)
    tools = tmp_path / "tools"
    tools.mkdir()
    monkeypatch.setattr(Machine, "is_this", property(lambda _: True))
    monkeypatch.setattr(os, "geteuid", lambda: 1000)
    monkeypatch.setenv("PATH", str(tools), prepend=os.pathsep)
    return tools


def _tool(place: Path, script: str) -> None:
    place.write_text(f"#!/bin/sh\n{script}\n")
    place.chmod(0o755)


def test_a_person_becomes_the_administrator_for_just_this(as_a_person: Path, tmp_path: Path) -> None:
    _tool(as_a_person / "sudo", 'exec "$@"')
    _tool(as_a_person / "udevadm", f'echo "$*" >> {tmp_path}/told')
    machine = Machine(tmp_path)
    install = rules_install(machine, "sudo")
    assert install.command[0] == "sudo"
    install_rules(install)
    assert rules_are_installed(machine)
    assert (tmp_path / "told").read_text().splitlines() == [
        "control --reload",
        "trigger --subsystem-match=usb --action=add",
    ]


def test_a_wrong_password_is_said(as_a_person: Path, tmp_path: Path) -> None:
    _tool(as_a_person / "sudo", "exit 1")
    machine = Machine(tmp_path)
    with pytest.raises(WorldError, match="sudo ended with 1"):
        install_rules(rules_install(machine, "sudo"))
    assert not rules_are_installed(machine)


def test_without_a_way_to_become_the_administrator_it_is_said(as_a_person: Path, tmp_path: Path) -> None:
    assert as_a_person.is_dir()
    with pytest.raises(WorldError, match="there is no becomes-root"):
        rules_install(Machine(tmp_path), "becomes-root")


def test_a_helper_that_cannot_be_started_is_said(tmp_path: Path) -> None:
    with pytest.raises(WorldError, match="not installed"):
        udev._run((str(tmp_path / "nothing"),))
