"""The seven steps: what a change upstream does to what depends on it."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fruitgui.station.workflow import (
    CalibrationFacts,
    Facts,
    ModelFacts,
    State,
    Step,
    TaughtFacts,
    opening_step,
    step_states,
)

SENSORS = {"left": "A1", "right": "B2"}
ENOUGH = {"lemon": (60, 12), "orange": (55, 10)}
FINISHED = Facts(
    sensors=SENSORS,
    reference="left",
    calibration=CalibrationFacts("c1", SENSORS, "left"),
    belt_calibration="c1",
    taught=TaughtFacts("t1", ENOUGH),
    model=ModelFacts("c1", "t1", ("lemon", "orange")),
    lots=2,
)

names = st.sampled_from(["left", "right", "third"])
rigs = st.dictionaries(names, st.sampled_from(["", "A1", "B2"]), min_size=1)
prints = st.sampled_from(["p", "q"])
kinds = st.dictionaries(
    st.sampled_from(["lemon", "orange", "apple"]), st.tuples(st.integers(0, 80), st.integers(0, 20))
)
facts = st.builds(
    Facts,
    sensors=st.none() | rigs,
    reference=st.none() | names,
    missing=st.lists(names, unique=True).map(tuple),
    calibration=st.none() | st.builds(CalibrationFacts, prints, rigs, names, st.booleans()),
    belt_calibration=st.none() | prints,
    taught=st.none() | st.builds(TaughtFacts, prints, kinds),
    model=st.none()
    | st.builds(ModelFacts, st.none() | prints, st.none() | prints, kinds.map(lambda one: tuple(sorted(one)))),
    lots=st.integers(0, 3),
    running=st.booleans(),
)


def codes(known: Facts, step: Step) -> list[str]:
    state = step_states(known)[step]
    reasons = [] if state.reason is None else [state.reason.code]
    return reasons + [remark.code for remark in state.remarks]


def test_at_first_only_connecting_can_be_begun() -> None:
    states = step_states(Facts())
    assert [step for step in Step if states[step].state is State.READY] == [Step.CONNECT]
    assert opening_step(states) is Step.CONNECT


def test_a_finished_station_opens_at_the_live_screen() -> None:
    states = step_states(FINISHED)
    assert opening_step(states) is Step.LIVE
    assert all(states[step].state is State.DONE for step in Step if step is not Step.LIVE)


def test_a_new_calibration_asks_for_the_belt_again_and_leaves_the_model_in_use() -> None:
    known = replace(FINISHED, calibration=CalibrationFacts("c2", SENSORS, "left"))
    states = step_states(known)
    assert (states[Step.BELT].state, codes(known, Step.BELT)) == (State.REDO, ["calibrated_since"])
    assert (states[Step.TRAIN].state, codes(known, Step.TRAIN)) == (State.DONE, ["earlier_calibration"])
    assert states[Step.TEACH].state is State.DONE
    assert states[Step.LIVE].state is State.TO_DO
    assert opening_step(states) is Step.BELT


def test_another_device_under_the_same_name_asks_for_calibrating() -> None:
    known = replace(FINISHED, sensors={"left": "A1", "right": "C3"})
    state = step_states(known)[Step.CALIBRATE]
    assert state.state is State.REDO
    assert state.reason is not None
    assert state.reason.data == {"added": [], "removed": [], "exchanged": ["right"]}


def test_a_bumped_rig_asks_for_calibrating() -> None:
    assert FINISHED.calibration is not None
    known = replace(FINISHED, calibration=replace(FINISHED.calibration, moved=True))
    assert codes(known, Step.CALIBRATE) == ["rig_moved"]
    assert step_states(known)[Step.LIVE].state is State.TO_DO


def test_with_one_sensor_gone_the_others_can_run() -> None:
    known = replace(FINISHED, missing=("right",))
    states = step_states(known)
    assert states[Step.CONNECT].state is State.REDO
    assert states[Step.LIVE].state is State.READY
    assert "sensors_missing" in codes(known, Step.LIVE)
    assert step_states(replace(known, missing=tuple(SENSORS)))[Step.LIVE].state is State.TO_DO


def test_without_a_model_the_line_runs_and_says_so() -> None:
    known = replace(FINISHED, model=None)
    assert step_states(known)[Step.LIVE].state is State.READY
    assert codes(known, Step.LIVE) == ["no_model"]
    assert step_states(known)[Step.TRAIN].state is State.READY


def test_samples_after_training_are_said_and_a_new_kind_asks_for_training() -> None:
    more = replace(FINISHED, taught=TaughtFacts("t2", ENOUGH))
    assert codes(more, Step.TRAIN) == ["taught_since"]
    new = replace(FINISHED, taught=TaughtFacts("t2", {**ENOUGH, "apple": (50, 10)}))
    assert (step_states(new)[Step.TRAIN].state, codes(new, Step.TRAIN)) == (State.REDO, ["kinds_changed"])


def test_progress_of_teaching_is_told_by_kind() -> None:
    known = replace(FINISHED, taught=TaughtFacts("t", {"lemon": (60, 12), "orange": (60, 9)}))
    state = step_states(known)[Step.TEACH]
    assert state.state is State.READY
    assert state.remarks[0].data == {"kinds": {"orange": (60, 9)}}


@given(facts)
def test_every_step_has_a_state_and_a_reason_exactly_where_it_needs_one(known: Facts) -> None:
    states = step_states(known)
    assert list(states) == list(Step)
    for state in states.values():
        assert (state.reason is not None) == (state.state in (State.TO_DO, State.REDO))


@given(facts)
def test_a_step_waits_only_for_one_before_it_that_is_not_done(known: Facts) -> None:
    states = step_states(known)
    order = list(Step)
    for step, state in states.items():
        if state.reason is not None and state.reason.code == "waits_for":
            other = state.reason.data["step"]
            assert order.index(other) < order.index(step)
            assert states[other].state is not State.DONE or step is Step.LOTS


@given(facts)
def test_there_is_always_something_to_do(known: Facts) -> None:
    states = step_states(known)
    assert states[opening_step(states)].state in (State.READY, State.DONE, State.REDO)


@given(facts, st.sampled_from(["c8", "c9"]))
def test_a_new_calibration_never_leaves_a_belt_done(known: Facts, fingerprint: str) -> None:
    if known.calibration is None:
        return
    states = step_states(replace(known, calibration=replace(known.calibration, fingerprint=fingerprint)))
    assert states[Step.BELT].state is not State.DONE


@given(facts)
def test_nothing_downstream_changes_what_is_upstream(known: Facts) -> None:
    before = step_states(known)
    after = step_states(replace(known, lots=known.lots + 1, model=None, taught=None))
    for step in (Step.CONNECT, Step.CALIBRATE, Step.BELT):
        assert before[step] == after[step]


@pytest.mark.parametrize("step", list(Step))
def test_steps_are_written_as_words(step: Step) -> None:
    assert f"{step}" == step.value
