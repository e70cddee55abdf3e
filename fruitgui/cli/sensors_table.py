"""A checkup as a person reads it in a terminal: a table, and below it what is wrong with what to do."""

from __future__ import annotations

import io
import shutil
import sys
from collections.abc import Iterable

from rich.console import Console as RichConsole
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from fruitgui.sensors.usb.problems import Problem
from fruitgui.station.checkup.records import CheckedController, CheckedSensor, Checkup, SensorState

WORDS = {
    SensorState.READY: ("ready", "green"),
    SensorState.RUNNING: ("running", "green"),
    SensorState.SILENT: ("no pictures", "red"),
    SensorState.FAILED: ("failed", "red"),
    SensorState.HANGS: ("hangs", "red"),
    SensorState.BUSY: ("in use", "yellow"),
    SensorState.NO_ACCESS: ("no access", "red"),
    SensorState.NO_DRIVER: ("no driver", "red"),
}


def table_text(checkup: Checkup) -> str:
    """Return the text, as wide as the terminal and coloured where it is one."""
    page = io.StringIO()
    width = shutil.get_terminal_size((100, 24)).columns
    rich = RichConsole(file=page, width=width, force_terminal=sys.stdout.isatty(), highlight=False)
    if checkup.sensors:
        rich.print(_sensors(checkup.sensors))
    if any(one.sensors for one in checkup.controllers):
        rich.print()
        rich.print(_controllers(checkup.controllers))
    if checkup.sensors:
        rich.print()
    _say_problems(rich, "", checkup.problems)
    for sensor in checkup.sensors:
        _say_problems(rich, sensor.name, sensor.problems)
    for sensor in checkup.sensors:
        for limit in sensor.limits:
            rich.print(Text(f"{sensor.name}: {limit}", style="dim"))
    if checkup.sensors and not checkup.all_problems:
        rich.print(Text("Nothing is wrong.", style="green"))
    return "\n".join(line.rstrip() for line in page.getvalue().rstrip().splitlines())


def _sensors(sensors: Iterable[CheckedSensor]) -> Table:
    table = Table(box=None, pad_edge=False, header_style="bold")
    for head in ("Sensor", "Model", "Serial", "USB"):
        table.add_column(head, overflow="fold")
    table.add_column("State")
    table.add_column("Pictures/s", justify="right")
    table.add_column("Lost", justify="right")
    for one in sensors:
        word, colour = WORDS[one.state]
        measured = one.measured
        rate = "-" if measured is None else f"{measured.rate_hz:.1f}"
        lost = "-" if measured is None else str(measured.lost)
        cells = (one.name, one.model, one.serial or "-", _place(one))
        table.add_row(*(Text(cell) for cell in cells), Text(word, style=colour), Text(rate), Text(lost))
    return table


def _place(sensor: CheckedSensor) -> str:
    place = sensor.place
    port = place.port or ("-" if place.bus is None else f"bus {place.bus}")
    return port if place.speed_mbps is None else f"{port} at {place.speed_mbps:g} Mbit/s"


def _controllers(controllers: Iterable[CheckedController]) -> Table:
    table = Table(box=None, pad_edge=False, header_style="bold")
    for head in ("USB controller", "Buses", "Sensors", "Room for Kinects taken"):
        table.add_column(head, overflow="fold")
    for one in controllers:
        load = "-" if one.load is None else f"{100 * one.load:.0f} %"
        style = "red" if one.load is not None and one.load > 1.0 else ""
        cells = (one.address, ", ".join(str(bus) for bus in one.buses), ", ".join(one.sensors) or "-")
        table.add_row(*(Text(cell) for cell in cells), Text(load, style=style))
    return table


def _say_problems(rich: RichConsole, whose: str, problems: Iterable[Problem]) -> None:
    for one in problems:
        rich.print(Text(f"{whose}: {one.what}" if whose else one.what, style="yellow"))
        rich.print(Padding(Text(one.remedy), (0, 0, 0, 2)))
