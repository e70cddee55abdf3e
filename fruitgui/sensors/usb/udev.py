"""The udev rules that let everybody use depth sensors, and how they get into the system."""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

from fruitgui.errors import WorldError
from fruitgui.files import read_text, written_whole
from fruitgui.resources import folder
from fruitgui.sensors.usb.machine import Machine

NAME = "60-fruitgui.rules"
REMEDY = "Install them by hand: copy the file to /etc/udev/rules.d as the administrator, then restart."
RELOAD = "udevadm control --reload && udevadm trigger --subsystem-match=usb --action=add"
ASKING_S = 300.0
"""How long a person may take to give the administrator's password."""


@dataclass(frozen=True, slots=True)
class RulesInstall:
    """What installing would do.

    Attributes:
        source: the file of rules that travels with the program.
        target: where it goes.
        command: that is run as the administrator; empty where this person may write there as it is.
        machine: into which they go.
    """

    source: Path
    target: Path
    command: tuple[str, ...]
    machine: Machine

    @property
    def text(self) -> str:
        """The rules."""
        return read_text(self.source)

    def shown(self) -> str:
        """Return what will be done, as a person could type it."""
        if self.command:
            return shlex.join(self.command)
        copy = f"install -m 0644 {shlex.quote(str(self.source))} {shlex.quote(str(self.target))}"
        return f"{copy} && {RELOAD}" if self.machine.is_this else copy


def rules_file() -> Path:
    """Return the file of rules that travels with the program."""
    return folder("udev") / NAME


def rules_target(machine: Machine) -> Path:
    """Return where the rules belong."""
    return machine.root / "etc/udev/rules.d" / NAME


def rules_are_installed(machine: Machine) -> bool:
    """Tell whether the system has these very rules."""
    try:
        return rules_target(machine).read_bytes() == rules_file().read_bytes()
    except OSError:
        return False


def rules_install(machine: Machine, becoming: str) -> RulesInstall:
    """Return what installing the rules would do.

    Args:
        machine: into which they go.
        becoming: the program that makes one the administrator: `sudo` in a terminal, `pkexec` in a window.

    Raises:
        WorldError: the system has no udev, or there is no such program where one is needed.
    """
    source, target = rules_file(), rules_target(machine)
    if not target.parent.parent.is_dir():
        what = f"This system has no udev: there is no folder {target.parent.parent}."
        raise WorldError("no_udev", what, "Rules are of use on Linux with udev only.", file=target.parent.parent)
    if not machine.is_this or os.geteuid() == 0:
        return RulesInstall(source, target, (), machine)
    if shutil.which(becoming) is None:
        raise WorldError("not_administrator", f"Only the administrator may do it, and there is no {becoming}.", REMEDY)
    script = f'install -D -m 0644 "$1" "$2" && {RELOAD}'
    return RulesInstall(source, target, (becoming, "sh", "-c", script, "sh", str(source), str(target)), machine)


def install_rules(install: RulesInstall) -> None:
    """Install the rules, and let them be applied to what is plugged in; ask before.

    Raises:
        WorldError: it was refused, or the file cannot be written.
    """
    if install.command:
        _run(install.command)
        return
    target = install.target
    try:
        target.parent.mkdir(exist_ok=True)
    except OSError as error:
        what = f"Cannot make {target.parent}: {error.strerror}."
        raise WorldError("cannot_write", what, REMEDY, file=target.parent) from error
    with written_whole(target) as beside:
        beside.write_bytes(install.source.read_bytes())
    target.chmod(0o644)
    if install.machine.is_this:
        _run(("sh", "-c", RELOAD))


def _run(command: tuple[str, ...]) -> None:
    try:
        done = subprocess.run(command, check=False, timeout=ASKING_S, stdout=subprocess.DEVNULL)  # noqa: S603 - shown before
    except (OSError, subprocess.TimeoutExpired) as error:
        raise WorldError("rules_not_installed", f"The rules were not installed: {error}.", REMEDY) from error
    if done.returncode:
        what = f"The rules were not installed: {command[0]} ended with {done.returncode}."
        raise WorldError("rules_not_installed", what, REMEDY)
