"""The whole of it on a plain world of balls that is not the product's own simulation."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest

from fruitgui.calibration.calibrate import calibrate
from fruitgui.calibration.result import Calibration, Refusal
from fruitgui.errors import CancelledByUserError, InputError
from fruitgui.frame import Frame
from fruitgui.geometry.pose import Pose
from tests.unit.calibration.worlds import OPPOSED, Ball, frames_of, scattered


def opposed(balls: list[Ball], others: list[Ball] | None = None) -> dict[str, list[Frame]]:
    return {
        "left": frames_of("left", OPPOSED["left"], balls, seed=1),
        "right": frames_of("right", OPPOSED["right"], balls if others is None else others, seed=2),
    }


def true_pose(source: str, reference: str) -> Pose:
    return OPPOSED[reference].inverse() @ OPPOSED[source]


def codes(result: Calibration | Refusal) -> set[str]:
    assert isinstance(result, Refusal)
    return {reason.code for reason in result.reasons}


@dataclass(frozen=True)
class Run:
    result: Calibration
    said: tuple[float, ...]


@cache
def usual(reference: str) -> Run:
    """Calibrate the usual pair, once for all tests that look at it."""
    said: list[float] = []
    result = calibrate(
        opposed(scattered(5)), reference, lambda fraction, _: said.append(fraction), with_paper=reference == "left"
    )
    assert isinstance(result, Calibration)
    return Run(result, tuple(said))


@pytest.mark.parametrize("reference", ["left", "right"])
def test_opposed_sensors_find_each_other(reference: str) -> None:
    result = usual(reference).result
    assert result.rig.reference == reference
    other = "right" if reference == "left" else "left"
    mount = result.rig.mounts[other]
    off_m, off_rad = mount.pose.distance_to(true_pose(other, reference), mount.footprint_m())
    assert off_m < 2e-3
    assert np.degrees(off_rad) < 0.1
    assert mount.pose.covariance is not None
    assert (np.linalg.eigvalsh(mount.pose.covariance) > 0).all()
    assert np.all(result.rig.mounts[reference].pose.covariance == 0)


def test_one_sensor_alone_is_a_rig() -> None:
    result = calibrate({"left": frames_of("left", OPPOSED["left"], [], seed=1)})
    assert isinstance(result, Calibration)
    assert result.rig.mounts["left"].surface.region_m is not None


def test_bare_belt_is_refused() -> None:
    assert codes(calibrate(opposed([]))) == {"too_little_structure"}


def test_equal_balls_in_a_row_are_refused() -> None:
    row = [Ball(0.11 * k, 0.0, 0.035) for k in range(-2, 3)]
    assert codes(calibrate(opposed(row))) == {"ambiguous"}


def test_one_odd_colour_in_the_row_decides() -> None:
    row = [Ball(0.11 * k, 0.0, 0.035) for k in range(-2, 3)]
    row[0] = Ball(row[0].x_m, 0.0, 0.035, (40, 160, 60))
    result = calibrate(opposed(row))
    if isinstance(result, Calibration):  # a row alone may hold too loosely; what it must not be is turned round
        off_m, _ = result.rig.mounts["right"].pose.distance_to(
            true_pose("right", "left"), result.rig.mounts["right"].footprint_m()
        )
        assert off_m < 3e-3
    else:
        assert codes(result) <= {"too_little_structure"}


def test_a_ball_carried_off_between_the_captures_of_two_sensors_is_refused() -> None:
    balls = scattered(5)
    moved = [*balls[:-1], Ball(balls[-1].x_m, balls[-1].y_m, balls[-1].radius_m)]
    free = next(
        (x, y)
        for x in np.linspace(-0.3, 0.3, 13)
        for y in np.linspace(-0.2, 0.2, 9)
        if all(np.hypot(x - b.x_m, y - b.y_m) > 0.1 for b in balls)
    )
    moved[-1] = Ball(float(free[0]), float(free[1]), balls[-1].radius_m)
    assert codes(calibrate(opposed(balls, moved))) == {"scene_moved"}


def test_sensors_of_different_scenes_are_refused() -> None:
    result = calibrate(opposed(scattered(5), scattered(77)))
    assert codes(result) <= {"too_little_overlap", "disconnected", "scene_moved", "ambiguous"}
    assert codes(result)


def test_reasons_tell_what_to_do() -> None:
    result = calibrate(opposed([]))
    assert isinstance(result, Refusal)
    assert all(reason.what and reason.remedy and reason.sensors for reason in result.reasons)


def test_unknown_reference_and_no_frames_are_said() -> None:
    with pytest.raises(InputError, match="no sensor"):
        calibrate(opposed([]), "middle")
    with pytest.raises(InputError):
        calibrate({})


def test_cancel_stops_it() -> None:
    with pytest.raises(CancelledByUserError):
        calibrate(opposed([]), cancelled=lambda: True)


def test_progress_only_goes_forward() -> None:
    said = usual("left").said
    assert list(said) == sorted(said)
    assert 0.0 <= said[0] <= said[-1] <= 1.0


def test_the_source_method_comes_along_when_asked_for() -> None:
    result = usual("left").result
    off_m, _ = result.paper["right"].distance_to(true_pose("right", "left"), np.array([[0.0, 0.0, 1.0]]))
    assert 0 < off_m < 0.05
