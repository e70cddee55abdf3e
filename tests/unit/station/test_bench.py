"""The processes beside the line: who gets what, and what becomes of it when one dies."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator

import pytest

from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rig import Mount, Rig
from fruitgui.simulation.device import KINECT_COLOR
from fruitgui.station.crew import Eye
from fruitgui.station.live.bench import Bench
from fruitgui.station.live.helper import HANDED, HelperLostError, Look, Skills
from tests.unit.perception.spheres import Ball, Table

TABLE = Table((Ball(0.0, 0.0, 0.035, (200, 60, 40)),), tilt_rad=0.0, intrinsics=KINECT_COLOR, seed=1)
PATIENCE_S = 60.0


@pytest.fixture
def skills() -> Skills:
    frame = TABLE.frame()
    rig = Rig(frame.sensor, {frame.sensor: Mount(frame.sensor, Pose.exact(), TABLE.surface(), KINECT_COLOR)})
    return Skills({frame.sensor: Eye(frame.sensor, KINECT_COLOR, TABLE.surface())}, rig, None)


@pytest.fixture
def bench(skills: Skills) -> Iterator[Bench]:
    bench = Bench(skills, helpers=2)
    bench.start()
    try:
        _until(lambda: all(helper.works for helper in bench.helpers))
        yield bench
    finally:
        bench.close()


def test_jobs_go_to_whoever_has_the_fewest_and_wait_for_room(bench: Bench, skills: Skills) -> None:
    expected = skills.worker().look(Look(TABLE.frame(), 1.0))
    most = 0
    answers = []
    for number in range(12):
        answer = bench.hand(Look(TABLE.frame(), float(number)))
        assert answer is not None
        answers.append(answer)
        most = max(most, *(helper.outstanding for helper in bench.helpers))
    seen = [answer.result(PATIENCE_S) for answer in answers]
    assert most <= HANDED
    assert [one.time_s for one in seen] == [float(number) for number in range(12)]
    assert all((one.views[0].centre_m == expected.views[0].centre_m).all() for one in seen)
    _until(lambda: bench.idle)


def test_the_other_helper_goes_on_when_one_dies_and_nobody_waits_when_all_have(bench: Bench) -> None:
    first, second = bench.helpers
    first.kill()
    _until(lambda: not first.works)
    answer = bench.hand(Look(TABLE.frame(), 1.0))
    assert answer is not None
    assert len(answer.result(PATIENCE_S).views) == 1
    asked: list[object] = []

    def ask_on() -> None:
        while (answer := bench.hand(Look(TABLE.frame(), 1.0))) is not None:
            asked.append(answer)

    thread = threading.Thread(target=ask_on)
    thread.start()
    _until(lambda: len(asked) > HANDED)
    second.kill()
    thread.join(PATIENCE_S)
    assert not thread.is_alive()
    assert bench.hand(Look(TABLE.frame(), 1.0)) is None
    ends = [answer.exception(PATIENCE_S) for answer in asked]  # type: ignore[attr-defined]
    assert all(end is None or isinstance(end, HelperLostError) for end in ends)
    assert not bench.idle


def test_without_helpers_nobody_takes_anything(skills: Skills) -> None:
    bench = Bench(skills, helpers=0)
    bench.start()
    assert bench.hand(Look(TABLE.frame(), 1.0)) is None
    assert not bench.idle
    bench.close()


def _until(true: Callable[[], bool]) -> None:
    until_s = time.monotonic() + PATIENCE_S
    while not true():
        assert time.monotonic() < until_s
        threading.Event().wait(0.01)
