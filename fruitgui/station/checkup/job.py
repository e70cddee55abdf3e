"""The job: look the USB over, ask the drivers, run what can be run, and say what is wrong."""

from __future__ import annotations

import os
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace

from fruitgui.progress import Cancelled, Progress, never_cancelled, no_progress, stop_if
from fruitgui.sensors.drivers import Driver, known_drivers
from fruitgui.sensors.feed import LOST_SHARE, SLOW_SHARE
from fruitgui.sensors.named import NamedSensor
from fruitgui.sensors.usb.bandwidth import PROMISED_US, BusLoad, bus_loads
from fruitgui.sensors.usb.findings import UsbView, look_over
from fruitgui.sensors.usb.machine import Machine
from fruitgui.sensors.usb.problems import Problem, problem, problem_of
from fruitgui.sensors.usb.tree import HIGH_SPEED_MBPS
from fruitgui.station.checkup.asking import ANSWER_S, ask
from fruitgui.station.checkup.joining import Joined, joined
from fruitgui.station.checkup.measuring import HELD_S, Outcome, Watching, measure
from fruitgui.station.checkup.records import CheckedController, CheckedSensor, Checkup, Measured, SensorState

ALWAYS_ASKED = ("kinect",)
"""Drivers whose library is small and belongs to the system. A vendor's SDK is loaded only where the USB shows a device
that it reads."""

TOLD_STATES = {
    "sensor_busy": SensorState.BUSY,
    "sensor_held": SensorState.BUSY,
    "sensor_not_allowed": SensorState.NO_ACCESS,
}
"""The states that a driver's own words tell, by their code."""


@dataclass(frozen=True, slots=True)
class CheckupPlan:
    """What is looked at, and how.

    Attributes:
        seconds: how long sensors are watched; 0 runs none.
        machine: the system.
        drivers: of all makes.
        watching: runs the sensors.
        known_as: names that people gave to sensors, by serial.
        answer_s: how long a driver may take to say what is plugged in.
    """

    seconds: float
    machine: Machine = field(default_factory=Machine)
    drivers: Sequence[Driver] = field(default_factory=known_drivers)
    watching: Watching = measure
    known_as: Mapping[str, str] = field(default_factory=dict)
    answer_s: float = ANSWER_S


def check_up(plan: CheckupPlan, progress: Progress = no_progress, cancelled: Cancelled = never_cancelled) -> Checkup:
    """Return what is connected and what is wrong with it. Nothing of that is an error.

    Raises:
        CancelledByUserError: it was cancelled; no sensor runs any more.
    """
    progress(0.0, "Looking at the USB")
    view = look_over(plan.machine, os.getpid())
    stop_if(cancelled)
    progress(0.05, "Asking the drivers")
    answers = ask(_of_use(plan.drivers, view), plan.answer_s)
    stop_if(cancelled)
    found = joined(view, answers, plan.known_as)
    outcomes = _run(found, plan, progress, cancelled) if plan.seconds > 0 else {}
    sensors = tuple(_with_outcome(one.checked, outcomes.get(one.checked.name), plan.seconds) for one in found)
    answered = [one.problem for one in answers if one.problem is not None]
    missing = [one.unusable for one in answers if one.unusable is not None and not found]
    loads = bus_loads(
        (one.place.bus, one.name) for one in sensors if one.make == "kinect" and one.place.bus is not None
    )
    full = _full_buses(view, loads, {one.name for one in sensors if _runs_well(one)})
    problems = [*_nothing(view, found, answered), *missing, *answered, *view.problems, *full]
    progress(1.0, "Done")
    return Checkup(sensors, tuple(problems), _controllers(view, sensors, loads))


def _of_use(drivers: Sequence[Driver], view: UsbView) -> list[Driver]:
    plugged = {one.known.make for one in view.sensors}
    return [one for one in drivers if one.make in plugged or one.make in ALWAYS_ASKED]


def _run(found: Sequence[Joined], plan: CheckupPlan, progress: Progress, cancelled: Cancelled) -> Mapping[str, Outcome]:
    tried = (SensorState.READY, SensorState.BUSY)
    sensors = [
        NamedSensor(one.sensor, one.checked.name)
        for one in found
        if one.sensor is not None and one.checked.state in tried
    ]
    return plan.watching(sensors, plan.seconds, progress, cancelled) if sensors else {}


def _with_outcome(checked: CheckedSensor, outcome: Outcome | None, seconds: float) -> CheckedSensor:
    if outcome is None:
        return checked
    problems = [*_still_true(checked.problems, outcome), *_of_outcome(checked, outcome, seconds)]
    state = outcome.state
    if state is SensorState.FAILED:
        told = None if outcome.error is None else TOLD_STATES.get(outcome.error.code)
        state = told or (SensorState.BUSY if checked.state is SensorState.BUSY else state)
    return replace(checked, state=state, measured=outcome.measured, problems=tuple(problems))


def _still_true(problems: Sequence[Problem], outcome: Outcome) -> list[Problem]:
    """Return the problems that are left after a sensor ran: one that gave pictures is in nobody's way."""
    if outcome.error is not None and outcome.error.code == "sensor_held":
        return [one for one in problems if one.code != "kernel_driver"]  # what promised to take it over could not
    if outcome.state is not SensorState.RUNNING:
        return list(problems)
    return [one for one in problems if one.code not in ("busy", "kernel_driver")]


def _of_outcome(checked: CheckedSensor, outcome: Outcome, seconds: float) -> list[Problem]:
    if outcome.state is SensorState.HANGS:
        return [problem("hangs")]
    if outcome.state is SensorState.FAILED:
        explained = any(one.code == "busy" for one in checked.problems)
        return [] if explained or outcome.error is None else [problem_of(outcome.error)]
    measured = outcome.measured
    if measured is None:
        return [problem("silent", seconds=f"{seconds:g}")]
    found = [problem("fell_silent")] if outcome.state is SensorState.SILENT and measured.frames else []
    if measured.rate_hz < SLOW_SHARE * measured.nominal_hz:
        found.append(problem("slow", rate=f"{measured.rate_hz:.1f}", nominal=f"{measured.nominal_hz:.1f}"))
    everything = measured.frames + measured.lost
    if measured.lost > LOST_SHARE * everything:
        found.append(_loss(measured, everything))
    return found


def _loss(measured: Measured, everything: int) -> Problem:
    values = {"lost": str(measured.lost), "all": str(everything)}
    if not measured.late_s:
        return problem("loses", **values)
    return problem("loses_busy", **values, late=f"{measured.late_s * 1e3:.0f}", holds=f"{HELD_S * 1e3:.0f}")


def _nothing(view: UsbView, found: Sequence[Joined], answered: Sequence[Problem]) -> list[Problem]:
    if found or answered or any(one.code == "no_power" for one in view.problems):
        return []
    return [problem("nothing_connected" if view.shown else "no_usb")]


def _runs_well(sensor: CheckedSensor) -> bool:
    return sensor.state is SensorState.RUNNING and not any(
        one.code in ("slow", "loses", "loses_busy") for one in sensor.problems
    )


def _full_buses(view: UsbView, loads: Sequence[BusLoad], run_well: Collection[str]) -> list[Problem]:
    """Return a problem for each bus with more Kinects than it is sure to carry: some controllers carry more."""
    loaded = {view.tree.controller(load.bus) for load in loads}
    fast = [bus for bus in view.tree.buses.values() if bus.speed_mbps >= HIGH_SPEED_MBPS]
    free = [bus.controller for bus in fast if bus.controller not in loaded]
    found = []
    for load in (one for one in loads if not one.fits):
        address = view.tree.controller(load.bus)
        controller = f"bus {load.bus}" if address is None else f"{address}, bus {load.bus}"
        values = {"sensors": ", ".join(load.kinects), "controller": controller}
        if all(name in run_well for name in load.kinects):
            found.append(problem("bus_tight", **values))
        else:
            found.append(problem("bus_full", **values, free=free[0]) if free else problem("buses_full", **values))
    return found


def _controllers(
    view: UsbView, sensors: Sequence[CheckedSensor], loads: Sequence[BusLoad]
) -> tuple[CheckedController, ...]:
    share = {load.bus: load.wanted_us / PROMISED_US for load in loads}
    found = []
    for address in dict.fromkeys(bus.controller for bus in view.tree.buses.values()):
        buses = [bus for bus in view.tree.buses.values() if bus.controller == address]
        numbers = tuple(sorted(bus.number for bus in buses))
        on_it = tuple(one.name for one in sensors if one.place.bus in numbers)
        load = max((share[number] for number in numbers if number in share), default=None)
        driver = next((bus.driver for bus in buses if bus.driver), "")
        found.append(CheckedController(address, driver, numbers, on_it, load))
    return tuple(found)
