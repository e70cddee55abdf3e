"""What a checkup found, in the operator's language; what only a driver knows is said as it is."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QCoreApplication

from fruitgui.gui import error_words
from fruitgui.gui.numbers import count_text, number_text
from fruitgui.gui.steps.connect.words import Condition
from fruitgui.sensors.usb.problems import Problem
from fruitgui.station.checkup.records import CheckedSensor, Checkup, SensorState

translate = QCoreApplication.translate

RATES = ("rate", "nominal")
"""Values of problems that are numbers with decimals."""


def problem_words() -> Mapping[str, tuple[str, str]]:
    """Return what is wrong and what to do by a problem's code, with fields for its values."""
    return {**_of_the_system(), **_before_it_runs(), **_while_it_runs()}


def _of_the_system() -> Mapping[str, tuple[str, str]]:
    return {
        "nothing_connected": (
            translate("Checkup", "No depth sensor was found on this computer."),
            translate(
                "Checkup",
                "Plug one in straight at the computer, switch its power supply on, and check again after ten seconds.",
            ),
        ),
        "no_usb": (
            translate("Checkup", "No depth sensor was found: this system shows no USB at all."),
            translate(
                "Checkup",
                "In a virtual machine or a container, hand the computer's USB devices on to it. On a computer, look in "
                "its BIOS whether USB is switched off.",
            ),
        ),
        "bus_full": (
            translate(
                "Checkup",
                "{sensors} share one USB controller ({controller}); it has room for one Kinect with colour and depth.",
            ),
            translate(
                "Checkup",
                "Controller {free} has room: try one sensor in other sockets until this check shows it there.",
            ),
        ),
        "buses_full": (
            translate(
                "Checkup",
                "{sensors} share one USB controller ({controller}); it has room for one Kinect with colour and depth.",
            ),
            translate(
                "Checkup",
                "No other controller with room is known here: try other sockets, or add a USB card for each further "
                "Kinect.",
            ),
        ),
        "bus_tight": (
            translate(
                "Checkup",
                "{sensors} share one USB controller ({controller}), which is sure to carry one Kinect with colour and "
                "depth; they ran without loss now.",
            ),
            translate("Checkup", "Watch whether it stays so. If not, give one of them another controller."),
        ),
        "usbfs_memory": (
            translate("Checkup", "All programs together may hold {have} MB for USB, and these sensors need {need} MB."),
            translate(
                "Checkup",
                "As the administrator: echo {want} > /sys/module/usbcore/parameters/usbfs_memory_mb; to keep it, add "
                "usbcore.usbfs_memory_mb={want} to the kernel's command line.",
            ),
        ),
        "driver_hangs": (
            translate("Checkup", "The driver for {make} does not answer."),
            translate(
                "Checkup",
                "Unplug these sensors, plug them in again, and check again. If it stays so, restart the computer.",
            ),
        ),
        "driver_failed": (
            translate("Checkup", "The driver for {make} failed: {why}."),
            translate(
                "Checkup",
                "Unplug these sensors and plug them in again. If it stays so, install the program again.",
            ),
        ),
        "no_power": (
            translate("Checkup", "A Kinect shows its motor but no camera: it has no power."),
            translate(
                "Checkup", "Plug in its power supply, at the wall and at the cable. USB alone does not feed a Kinect."
            ),
        ),
    }  # fmt: skip


def _before_it_runs() -> Mapping[str, tuple[str, str]]:
    return {
        "unsupported": (
            translate("Checkup", "There is no driver for {model} in this version."),
            translate("Checkup", "Use a sensor that is supported, or record it with ROS 2 and open the recording."),
        ),
        "no_access": (
            translate("Checkup", "The system does not let you use it."),
            translate("Checkup", "Press “Let me use them…”. Then unplug it and plug it in again."),
        ),
        "no_access_yet": (
            translate("Checkup", "The system does not let you use it, although the rules are installed."),
            translate("Checkup", "Unplug it and plug it in again. If it stays so, restart the computer."),
        ),
        "no_node": (
            translate("Checkup", "The system knows it, but shows no file to use it through ({node})."),
            translate(
                "Checkup", "In a container, hand /dev/bus/usb on to it. Else unplug it and plug it in again."
            ),
        ),
        "busy": (
            translate("Checkup", "Another program has it open: {programs}."),
            translate("Checkup", "Close that program, then check again."),
        ),
        "kernel_driver": (
            translate("Checkup", "The system uses it as a webcam ({driver})."),
            translate("Checkup", "It is taken over when it runs. If that fails: sudo modprobe -r {driver}"),
        ),
        "slow_port": (
            translate("Checkup", "It runs at {speed} Mbit/s and needs {needed} Mbit/s to give all its pictures."),
            translate(
                "Checkup",
                "Use the cable that came with it, straight at the computer, in a socket of USB {usb}. Those of USB 3 "
                "are mostly blue.",
            ),
        ),
        "not_found": (
            translate("Checkup", "It is plugged in, but its driver does not find it."),
            translate("Checkup", "Unplug it and plug it in again, with its power supply."),
        ),
        "no_serial": (
            translate("Checkup", "It has the same serial as another sensor, or none: they cannot be told apart."),
            translate("Checkup", "Use one of them only, or one of another model."),
        ),
        "no_serial_alone": (
            translate("Checkup", "It has no serial: it can be run only as long as no other of its make is plugged in."),
            translate(
                "Checkup",
                "Plug in only this one. Where connecting does not list it, the line needs one that has a serial.",
            ),
        ),
        "closed": (
            translate("Checkup", "It cannot be opened: the system does not let you, or another sensor has its serial."),
            translate("Checkup", "Press “Let me use them…”. Of two with one serial, plug in only one."),
        ),
    }  # fmt: skip


def _while_it_runs() -> Mapping[str, tuple[str, str]]:
    return {
        "hangs": (
            translate("Checkup", "Its driver hangs."),
            translate("Checkup", "Unplug it and plug it in again, then check again."),
        ),
        "silent": (
            translate("Checkup", "It gave no picture in {seconds} s."),
            translate("Checkup", "Check its power supply and cable; give it a socket of its own, not on a hub."),
        ),
        "fell_silent": (
            translate("Checkup", "It stopped giving pictures while it was watched."),
            translate("Checkup", "Check that its plugs sit firmly, and its power supply."),
        ),
        "slow": (
            translate("Checkup", "It gives {rate} of {nominal} pictures a second."),
            translate("Checkup", "Give it a USB controller of its own, and close other programs."),
        ),
        "loses": (
            translate("Checkup", "It lost {lost} of {all} pictures, though this computer had time to take them."),
            translate("Checkup", "Use a shorter cable without a hub, and a USB controller of its own."),
        ),
        "loses_busy": (
            translate(
                "Checkup",
                "It lost {lost} of {all} pictures; this computer was too busy to take some of them: {late} ms late at "
                "worst, and a sensor waits some {holds} ms.",
            ),
            translate(
                "Checkup",
                "Close other programs and check again. If pictures are lost then too, and this computer is said to "
                "have time, it is the cable or the USB controller.",
            ),
        ),
    }


def said(problem: Problem) -> tuple[str, str]:
    """Return what is wrong and what to do, in the operator's language."""
    words = problem_words().get(problem.code) or error_words.words().get(problem.code)
    if words is None:
        return problem.what, problem.remedy
    values = {name: _number(text) if name in RATES else text for name, text in problem.values.items()}
    try:
        return words[0].format(**values), words[1].format(**values)
    except KeyError:  # a driver's error that happens to have the code of something else
        return problem.what, problem.remedy


def _number(text: str) -> str:
    return number_text(float(text), 1)


def state_words(sensor: CheckedSensor) -> Condition:
    """Return how a sensor is, with its health by the gravest of what is wrong."""
    words = {
        SensorState.READY: ("good", translate("Checkup", "ready")),
        SensorState.RUNNING: ("good", translate("Checkup", "runs")),
        SensorState.SILENT: ("bad", translate("Checkup", "no pictures")),
        SensorState.FAILED: ("bad", translate("Checkup", "failed")),
        SensorState.HANGS: ("bad", translate("Checkup", "hangs")),
        SensorState.BUSY: ("warn", translate("Checkup", "in use")),
        SensorState.NO_ACCESS: ("bad", translate("Checkup", "no access")),
        SensorState.NO_DRIVER: ("bad", translate("Checkup", "no driver")),
    }
    health, word = words[sensor.state]
    return Condition("warn" if health == "good" and sensor.problems else health, word)


def measured_text(sensor: CheckedSensor) -> str:
    """Return how many pictures it gave and lost; empty where it did not run."""
    measured = sensor.measured
    if measured is None:
        return ""
    rate = number_text(measured.rate_hz, 1)
    if not measured.lost:
        return translate("Checkup", "{rate} pictures a second, none lost").format(rate=rate)
    lost, everything = count_text(measured.lost), count_text(measured.frames + measured.lost)
    return translate("Checkup", "{rate} pictures a second, {lost} of {all} lost").format(
        rate=rate, lost=lost, all=everything
    )


def place_text(sensor: CheckedSensor) -> str:
    """Return where it hangs, as far as that is known."""
    place = sensor.place
    if place.controller is not None and place.port is not None:
        text = translate("Checkup", "Port {port} of USB controller {controller}")
        return text.format(port=place.port, controller=place.controller)
    if place.bus is not None:
        return translate("Checkup", "USB bus {bus}").format(bus=place.bus)
    return ""


def summary_text(checkup: Checkup) -> str:
    """Return all of it in one sentence."""
    found, wrong = len(checkup.sensors), len(checkup.all_problems)
    if not found:
        return translate("Checkup", "No sensor was found.")
    sensors = translate("Checkup", "1 sensor") if found == 1 else translate("Checkup", "{n} sensors").format(n=found)
    if not wrong:
        return translate("Checkup", "{sensors}; nothing is wrong.").format(sensors=sensors)
    if wrong == 1:
        return translate("Checkup", "{sensors}; one thing is wrong.").format(sensors=sensors)
    return translate("Checkup", "{sensors}; {n} things are wrong.").format(sensors=sensors, n=wrong)


def doing_words(doing: str) -> str:
    """Return what the core says while it checks, in the operator's language; what is not known is said as it is."""
    words = {
        "Looking at the USB": translate("Checkup", "Looking at the USB"),
        "Asking the drivers": translate("Checkup", "Asking the drivers"),
        "Starting the sensors": translate("Checkup", "Starting the sensors"),
        "Watching the sensors run": translate("Checkup", "Watching the sensors run"),
    }
    return words.get(doing, doing)
