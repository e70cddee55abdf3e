"""The names of the steps and the reasons of their states, in the operator's language."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from PySide6.QtCore import QCoreApplication

from fruitgui.station.workflow import State, Step, StepState, Why


def step_name(step: Step) -> str:
    """Return a step's name."""
    return {
        Step.CONNECT: QCoreApplication.translate("Steps", "Connect"),
        Step.CALIBRATE: QCoreApplication.translate("Steps", "Calibrate"),
        Step.BELT: QCoreApplication.translate("Steps", "Belt"),
        Step.TEACH: QCoreApplication.translate("Steps", "Teach"),
        Step.TRAIN: QCoreApplication.translate("Steps", "Train"),
        Step.LIVE: QCoreApplication.translate("Steps", "Live"),
        Step.LOTS: QCoreApplication.translate("Steps", "Lots"),
    }[step]


def way_words(step: Step) -> tuple[str, str]:
    """Return what stands on the button that leads to a step, and what is said of it."""
    return {
        Step.CONNECT: (step_name(step), QCoreApplication.translate("Steps", "Go to the sensors")),
        Step.CALIBRATE: (step_name(step), QCoreApplication.translate("Steps", "Go to calibrating")),
        Step.BELT: (QCoreApplication.translate("Steps", "Set the belt"),
                    QCoreApplication.translate("Steps", "Go to the belt")),
        Step.TEACH: (step_name(step), QCoreApplication.translate("Steps", "Go to teaching")),
        Step.TRAIN: (step_name(step), QCoreApplication.translate("Steps", "Go to training")),
        Step.LIVE: (QCoreApplication.translate("Steps", "Go live"),
                    QCoreApplication.translate("Steps", "Go to the live screen")),
        Step.LOTS: (step_name(step), QCoreApplication.translate("Steps", "Go to what has been run")),
    }[step]  # fmt: skip


def state_name(state: StepState) -> str:
    """Return how far a step is, in a word or two."""
    return {
        State.TO_DO: QCoreApplication.translate("Steps", "to do"),
        State.READY: QCoreApplication.translate("Steps", "ready"),
        State.DONE: QCoreApplication.translate("Steps", "done"),
        State.REDO: QCoreApplication.translate("Steps", "do again"),
    }[state.state]


def reason_text(state: StepState) -> str:
    """Return why a step is to be done (again), and what else should be known; empty where there is nothing to say."""
    reasons = (() if state.reason is None else (state.reason,)) + state.remarks
    return " ".join(text for text in map(why_text, reasons) if text)


def why_text(why: Why) -> str:
    """Return one reason or remark as a sentence."""
    return _SENTENCES[why.code](why.data)


def _waits_for(data: Mapping[str, Any]) -> str:
    text = QCoreApplication.translate("Steps", "First finish the step “{step}”.")
    return text.format(step=step_name(data["step"]))


def _sensors_missing(data: Mapping[str, Any]) -> str:
    text = QCoreApplication.translate("Steps", "Not there now: {sensors}.")
    return text.format(sensors=", ".join(data["sensors"]))


def _sensors_changed(data: Mapping[str, Any]) -> str:
    parts = {
        "added": QCoreApplication.translate("Steps", "added: {sensors}"),
        "removed": QCoreApplication.translate("Steps", "removed: {sensors}"),
        "exchanged": QCoreApplication.translate("Steps", "exchanged: {sensors}"),
    }
    told = "; ".join(text.format(sensors=", ".join(data[name])) for name, text in parts.items() if data.get(name))
    text = QCoreApplication.translate("Steps", "The sensors are not those that were calibrated ({changes}).")
    return text.format(changes=told)


def _reference_changed(data: Mapping[str, Any]) -> str:
    text = QCoreApplication.translate("Steps", "Another sensor is the reference now: {sensor}.")
    return text.format(sensor=data["reference"])


def _depth_changed(data: Mapping[str, Any]) -> str:
    text = QCoreApplication.translate("Steps", "Depth is corrected otherwise since: {sensors}. Calibrate again.")
    return text.format(sensors=", ".join(data["sensors"]))


def _few_samples(data: Mapping[str, Any]) -> str:
    each = ", ".join(f"{kind} ({samples}, {fruit})" for kind, (samples, fruit) in data["kinds"].items())
    text = QCoreApplication.translate("Steps", "More is to be taught (samples, pieces of fruit): {kinds}.")
    return text.format(kinds=each)


def _few_kinds(_data: Mapping[str, Any]) -> str:
    return QCoreApplication.translate("Steps", "Teach at least two kinds.")


def _kinds_changed(data: Mapping[str, Any]) -> str:
    told = ", ".join([*data.get("added", ()), *data.get("removed", ())])
    return QCoreApplication.translate("Steps", "The kinds taught are not those of the model ({kinds}).").format(
        kinds=told
    )


_SENTENCES: Mapping[str, Callable[[Mapping[str, Any]], str]] = {
    "waits_for": _waits_for,
    "sensors_missing": _sensors_missing,
    "sensors_changed": _sensors_changed,
    "reference_changed": _reference_changed,
    "depth_changed": _depth_changed,
    "rig_moved": lambda _: QCoreApplication.translate("Steps", "A sensor was moved; calibrate again."),
    "calibrated_since": lambda _: QCoreApplication.translate("Steps", "The sensors were calibrated again since."),
    "few_samples": _few_samples,
    "few_kinds": _few_kinds,
    "kinds_changed": _kinds_changed,
    "earlier_calibration": lambda _: QCoreApplication.translate("Steps", "Trained with an earlier calibration."),
    "taught_since": lambda _: QCoreApplication.translate("Steps", "More was taught since it was trained."),
    "no_model": lambda _: QCoreApplication.translate("Steps", "Without a model every fruit counts as unknown."),
    "running": lambda _: QCoreApplication.translate("Steps", "The line is running."),
}
