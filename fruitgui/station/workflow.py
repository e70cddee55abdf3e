"""Which of the seven steps is where, and why: a pure function of what exists and of what it was made from."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any

SAMPLES_PER_KIND = 50
FRUIT_PER_KIND = 10
KINDS_NEEDED = 2
"""Samples and distinct pieces of each kind that make teaching done, and kinds from which on training means anything."""


class Step(StrEnum):
    """The screens, in the order in which a person walks them."""

    CONNECT = "connect"
    CALIBRATE = "calibrate"
    BELT = "belt"
    TEACH = "teach"
    TRAIN = "train"
    LIVE = "live"
    LOTS = "lots"


class State(StrEnum):
    """How far a step is: it waits for another; it can be begun; it is done; it is to be done again."""

    TO_DO = "to_do"
    READY = "ready"
    DONE = "done"
    REDO = "redo"


@dataclass(frozen=True, slots=True)
class Why:
    """A reason or a remark: a stable word for the screen to put into a sentence, with its data.

    Codes: `waits_for` (step), `sensors_missing` (sensors), `sensors_changed` (added, removed, exchanged),
    `reference_changed` (reference), `depth_changed` (sensors), `rig_moved`, `calibrated_since`, `few_samples` (kinds:
    name to (samples, fruit)), `few_kinds` (kinds), `kinds_changed` (added, removed), `earlier_calibration`,
    `taught_since`, `no_model`, `running`.
    """

    code: str
    data: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class StepState:
    """Where one step is.

    Attributes:
        state: to_do, ready, done or redo.
        reason: why it is to_do or redo; None otherwise.
        remarks: what a person should know all the same.
    """

    state: State
    reason: Why | None = None
    remarks: tuple[Why, ...] = ()


@dataclass(frozen=True, slots=True)
class CalibrationFacts:
    """A calibration that exists: its fingerprint, its sensors (name to serial), its reference, and whether it holds.

    `moved`: the watch over the rig said that it was bumped. `depth_changed`: sensors whose depth is corrected otherwise
    since.
    """

    fingerprint: str
    sensors: Mapping[str, str]
    reference: str
    moved: bool = False
    depth_changed: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class TaughtFacts:
    """What was taught: its fingerprint, and by kind how many samples and distinct pieces of fruit."""

    fingerprint: str
    kinds: Mapping[str, tuple[int, int]]


@dataclass(frozen=True, slots=True)
class ModelFacts:
    """The model in use: fingerprints of the calibration and of the samples it was trained with, and its kinds.

    Of a model from elsewhere the fingerprints are None, and the kinds may be empty: not known.
    """

    calibration: str | None
    taught: str | None
    kinds: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Facts:
    """What exists.

    Attributes:
        sensors: of the connection, name to serial; None where nothing was connected yet.
        reference: name of the connection's reference.
        missing: sensors of the connection that are not there now.
        calibration: the station's, if there is one.
        belt_calibration: fingerprint of the calibration for which the belt was set.
        taught: samples, if there are any.
        model: in use, if there is one.
        lots: how many were run.
        running: the line runs now.
    """

    sensors: Mapping[str, str] | None = None
    reference: str | None = None
    missing: tuple[str, ...] = ()
    calibration: CalibrationFacts | None = None
    belt_calibration: str | None = None
    taught: TaughtFacts | None = None
    model: ModelFacts | None = None
    lots: int = 0
    running: bool = False


States = Mapping[Step, StepState]
READY, DONE = StepState(State.READY), StepState(State.DONE)


def step_states(facts: Facts) -> States:
    """Return the state of every step; each is judged with those before it known."""
    states: dict[Step, StepState] = {}
    for step, judge in _JUDGES.items():
        states[step] = judge(facts, states)
    return states


def opening_step(states: States) -> Step:
    """Return the step to open with: the live screen where the station is finished, else the first to be done."""
    if states[Step.LIVE].state in (State.READY, State.DONE):
        return Step.LIVE
    return next(step for step in Step if states[step].state in (State.READY, State.REDO))


def _connect(facts: Facts, _states: States) -> StepState:
    if not facts.sensors:
        return READY
    if facts.missing:
        return _redo("sensors_missing", sensors=facts.missing)
    return DONE


def _calibrate(facts: Facts, _states: States) -> StepState:
    made = facts.calibration
    if not facts.sensors:
        return _waits_for(Step.CONNECT)
    if made is None:
        return _waits_for(Step.CONNECT) if facts.missing else READY
    changed = _sensors_changed(facts.sensors, made.sensors)
    if changed is not None:
        return StepState(State.REDO, changed)
    if facts.reference is not None and facts.reference != made.reference:
        return _redo("reference_changed", reference=facts.reference)
    if made.depth_changed:
        return _redo("depth_changed", sensors=made.depth_changed)
    return _redo("rig_moved") if made.moved else DONE


def _sensors_changed(now: Mapping[str, str], then: Mapping[str, str]) -> Why | None:
    """Return how the sensors differ from those that were calibrated; a serial that is not known is believed."""
    added, removed = sorted(now.keys() - then.keys()), sorted(then.keys() - now.keys())
    both = sorted(now.keys() & then.keys())
    exchanged = [name for name in both if now[name] and then[name] and now[name] != then[name]]
    if not (added or removed or exchanged):
        return None
    return Why("sensors_changed", {"added": added, "removed": removed, "exchanged": exchanged})


def _belt(facts: Facts, states: States) -> StepState:
    if facts.calibration is None or states[Step.CALIBRATE].state is not State.DONE:
        return _waits_for(Step.CALIBRATE)
    if facts.belt_calibration is None:
        return READY
    return DONE if facts.belt_calibration == facts.calibration.fingerprint else _redo("calibrated_since")


def _teach(facts: Facts, states: States) -> StepState:
    kinds = {} if facts.taught is None else facts.taught.kinds
    few = {kind: have for kind, have in kinds.items() if have[0] < SAMPLES_PER_KIND or have[1] < FRUIT_PER_KIND}
    if len(kinds) >= KINDS_NEEDED and not few:
        return DONE
    remarks = (Why("few_samples", {"kinds": few}),) if few else ()
    if not kinds and states[Step.BELT].state is not State.DONE:
        return _waits_for(Step.BELT)
    return StepState(State.READY, remarks=remarks)


def _train(facts: Facts, _states: States) -> StepState:
    taught = {} if facts.taught is None else facts.taught.kinds
    if facts.model is not None:
        return _trained(facts.model, facts, tuple(taught))
    if len(taught) < KINDS_NEEDED:
        return StepState(State.TO_DO, Why("few_kinds", {"kinds": tuple(taught)}) if taught else _waiting(Step.TEACH))
    return READY


def _trained(model: ModelFacts, facts: Facts, taught: tuple[str, ...]) -> StepState:
    """Return the state of training where a model is in use; it stays in use whatever came after it."""
    added, removed = sorted(set(taught) - set(model.kinds)), sorted(set(model.kinds) - set(taught))
    if taught and model.kinds and (added or removed):
        return _redo("kinds_changed", added=added, removed=removed)
    remarks = []
    if facts.calibration is not None and model.calibration not in (None, facts.calibration.fingerprint):
        remarks.append(Why("earlier_calibration"))
    if facts.taught is not None and model.taught not in (None, facts.taught.fingerprint):
        remarks.append(Why("taught_since"))
    return StepState(State.DONE, remarks=tuple(remarks))


def _live(facts: Facts, states: States) -> StepState:
    remarks: tuple[Why, ...] = () if facts.model is not None else (Why("no_model"),)
    if facts.missing:
        remarks += (Why("sensors_missing", {"sensors": facts.missing}),)
    if facts.running:
        return StepState(State.DONE, remarks=(Why("running"), *remarks))
    if not facts.sensors or set(facts.missing) >= set(facts.sensors):
        return _waits_for(Step.CONNECT)
    for step in (Step.CALIBRATE, Step.BELT):
        if states[step].state is not State.DONE:
            return _waits_for(step)
    return StepState(State.READY, remarks=remarks)


def _lots(facts: Facts, _states: States) -> StepState:
    return DONE if facts.lots else _waits_for(Step.LIVE)


def _waiting(step: Step) -> Why:
    return Why("waits_for", {"step": step})


def _waits_for(step: Step) -> StepState:
    return StepState(State.TO_DO, _waiting(step))


def _redo(code: str, **data: object) -> StepState:
    return StepState(State.REDO, Why(code, data))


_JUDGES: Mapping[Step, Callable[[Facts, States], StepState]] = {
    Step.CONNECT: _connect,
    Step.CALIBRATE: _calibrate,
    Step.BELT: _belt,
    Step.TEACH: _teach,
    Step.TRAIN: _train,
    Step.LIVE: _live,
    Step.LOTS: _lots,
}
