"""Where a person goes from a step that cannot be done now: no screen ends without a way on."""

from __future__ import annotations

from dataclasses import replace

from fruitgui.station.workflow import States, Step, StepState, Why

_WAITS = "waits_for"
_MENDS = {
    "sensors_missing": Step.CONNECT,
    "sensors_changed": Step.CALIBRATE,
    "reference_changed": Step.CALIBRATE,
    "depth_changed": Step.CALIBRATE,
    "rig_moved": Step.CALIBRATE,
    "calibrated_since": Step.BELT,
    "few_samples": Step.TEACH,
    "few_kinds": Step.TEACH,
    "kinds_changed": Step.TRAIN,
    "earlier_calibration": Step.TRAIN,
    "taught_since": Step.TRAIN,
    "no_model": Step.TRAIN,
}


_ERRORS = {
    "bad_model": Step.TRAIN,
    "no_such_model": Step.TRAIN,
    "other_features": Step.TRAIN,
    "bad_station": Step.CALIBRATE,
    "no_sensor_in_common": Step.CALIBRATE,
}


def mends_error(code: str) -> Step | None:
    """Return the step that mends what an error says, by its code; None where it is mended nowhere in the window."""
    return _ERRORS.get(code)


def at_root(step: Step, states: States) -> StepState:
    """Return a step's state; where it waits for others, the reason is that of the one which can be begun."""
    state = states[step]
    reason = state.reason
    while reason is not None and reason.code == _WAITS:
        behind = states[Step(reason.data["step"])].reason
        if behind is None:
            break
        reason = behind
    return replace(state, reason=reason)


def ways_on(state: StepState) -> tuple[Step, ...]:
    """Return the steps that mend what keeps a step from being done, then those that mend what is remarked of it."""
    reasons = (() if state.reason is None else (state.reason,)) + state.remarks
    steps = (_mended_at(reason) for reason in reasons)
    return tuple(dict.fromkeys(step for step in steps if step is not None))


def _mended_at(why: Why) -> Step | None:
    if why.code == _WAITS:
        return Step(why.data["step"])
    return _MENDS.get(why.code)
