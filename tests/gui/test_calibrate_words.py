from __future__ import annotations

import math

import numpy as np
import pytest

from fruitgui.calibration.outlook import Outlook
from fruitgui.calibration.quality import belt_warnings
from fruitgui.calibration.result import REMEDIES, PairQuality, SensorQuality, reason
from fruitgui.geometry.plane import Plane, Surface
from fruitgui.geometry.pose import Pose
from fruitgui.gui.steps.calibrate.cloud import Side, extent_of, fitted, layer, weights
from fruitgui.gui.steps.calibrate.core_words import in_words
from fruitgui.gui.steps.calibrate.prospect import prospect_of
from fruitgui.gui.steps.calibrate.reasons import told
from fruitgui.gui.steps.calibrate.sketches import LENGTH, PREPARE, WIDTH, WRONG_AND_RIGHT
from fruitgui.gui.steps.calibrate.verdict import graph_of, kept_links, verdict_of, verdict_of_station
from fruitgui.station.calibrate_job import CalibrationOutcome, quality_value
from fruitgui.station.fused_cloud import SensorCloud
from fruitgui.station.outlook_watch import RigOutlook
from fruitgui.station.station import Station, StationSensor


def _pair(held_out_m: float = 0.0003, *, accepted: bool = True, things: int = 12) -> PairQuality:
    return PairQuality(("kinect_2", "kinect_1"), accepted, things, 0.8, 0.0009, held_out_m, 1.0, 0.002, 90.0)


def _quality(word: str = "good", position_std_m: float = 0.0004) -> SensorQuality:
    return SensorQuality(word, 24, 0.0012, 2e-4, 1e-4, position_std_m, 4e-4)  # type: ignore[arg-type]


def _outcome(*pairs: PairQuality, words: tuple[str, str] = ("good", "good")) -> CalibrationOutcome:
    surface = Surface(Plane(np.array([0.0, 0.0, -1.0]), 1.0))
    sensors = {name: StationSensor("", Pose.exact(), surface) for name in ("kinect_1", "kinect_2")}
    qualities = dict(zip(sensors, map(_quality, words), strict=True))
    return CalibrationOutcome(Station("kinect_1", sensors), qualities, pairs, (), ())


@pytest.mark.parametrize(
    ("outcome", "health", "word"),
    [
        (_outcome(_pair()), "good", "Good"),
        (_outcome(_pair(), words=("good", "usable")), "warn", "Usable"),
        (_outcome(_pair(0.0015)), "warn", "Usable"),
        (_outcome(_pair(0.0003), _pair(0.004, accepted=False)), "good", "Good"),
        (CalibrationOutcome(None, {}, (), (reason("ambiguous", ("a", "b"), "x"),), ()), "bad", "Redo"),
    ],
)
def test_health_is_one_of_three_words(outcome: CalibrationOutcome, health: str, word: str) -> None:
    verdict = verdict_of(outcome)
    assert (verdict.health, verdict.word) == (health, word)


def test_figures_come_after_the_words_with_their_units() -> None:
    figures = dict(verdict_of(_outcome(_pair())).figures)
    assert figures["Placed within (95 %)"] == "±\u20090.8\u2009mm"
    assert figures["Checked on pieces held out"] == "0.3\u2009mm"


def test_a_link_without_enough_to_hold_out_is_judged_by_its_residual() -> None:
    _, links = graph_of(("kinect_1", "kinect_2"), "kinect_1", {}, [_pair(math.nan, things=1)])
    assert (links[0].health, links[0].figure) == ("good", "0.9\u2009mm")


def test_a_kept_station_tells_the_same_as_when_it_was_made() -> None:
    made = _outcome(_pair())
    assert made.station is not None
    links = {"kinect_1": {"kinect_2": quality_value(_pair())}, "kinect_2": {"kinect_1": quality_value(_pair())}}
    sensors = {
        name: StationSensor(
            "", one.pose, one.surface, quality={**quality_value(made.sensors[name]), "links": links[name]}
        )
        for name, one in made.station.sensors.items()
    }
    station = Station("kinect_1", sensors)
    assert len(kept_links(station)) == 1
    assert verdict_of_station(station) == verdict_of(made)


def test_a_station_of_an_earlier_version_is_shown_without_what_it_does_not_tell() -> None:
    made = _outcome(_pair())
    assert made.station is not None
    assert kept_links(made.station) == []
    assert verdict_of_station(made.station).health == "warn"


@pytest.mark.parametrize("code", list(REMEDIES))
def test_every_refusal_has_three_sentences_and_two_pictures(code: str) -> None:
    one = told([reason(code, ("kinect_1", "kinect_2"), "")], [], ())[0]  # type: ignore[arg-type]
    assert "kinect_1, kinect_2" in one.seen
    assert one.why
    assert one.remedy
    wrong, right = WRONG_AND_RIGHT[code]
    assert (wrong.good, right.good) == (False, True)


def test_what_was_seen_of_a_pair_is_said_in_figures() -> None:
    given = reason("too_little_structure", ("kinect_1", "kinect_2"), "")
    assert "things in common 2, belt in common 80\u2009%" in told([given], [_pair(things=2)], ())[0].seen
    assert len(told([given, given], [], ())) == 1


def test_a_sensor_without_a_belt_is_told_from_one_that_is_held_loosely() -> None:
    given = reason("too_little_structure", ("kinect_2",), "")
    beltless, loose = (told([given], [], with_belt)[0] for with_belt in ((), ("kinect_2",)))
    assert "no flat surface" in beltless.seen
    assert "too loosely" in loose.seen
    assert beltless.remedy != loose.remedy


def test_sketches_lie_on_the_belt() -> None:
    for sketch in (*PREPARE, *(one for pair in WRONG_AND_RIGHT.values() for one in pair)):
        for piece in sketch.pieces:
            assert piece.radius <= piece.x <= LENGTH - piece.radius
            assert piece.radius <= piece.y <= WIDTH - piece.radius


def test_what_the_core_says_is_known_here() -> None:
    for said in (
        "Collected 12 of 60 frames", "Finding the belt of kinect_1", "Matching kinect_2 to kinect_1",
        "Placing the sensors",
    ):  # fmt: skip
        assert "{" not in in_words(said)
    quality = {"kinect_2": _quality("usable", 0.0011)}
    warning = belt_warnings({}, [], quality)[0]
    assert in_words(warning).startswith("kinect_2 is placed to 1.1 mm and 0.02° only")
    assert in_words("Something new.") == "Something new."


def _seen(things: int, common: int, *, belt: bool = True, moved: bool = False) -> RigOutlook:
    one = Outlook("kinect_1", belt, np.zeros((things, 2)), np.zeros((things, 5)), moved)
    return RigOutlook({"kinect_1": one, "kinect_2": one}, {("kinect_1", "kinect_2"): common})


@pytest.mark.parametrize(
    ("seen", "health", "says"),
    [
        (None, "", "Looking"),
        (_seen(12, 11), "good", "plenty"),
        (_seen(12, 6), "warn", "may do"),
        (_seen(3, 2), "bad", "little"),
        (_seen(0, 0, belt=False), "bad", "No belt"),
        (_seen(12, 11, moved=True), "warn", "moves"),
    ],
)
def test_the_meter_says_what_it_comes_to(seen: RigOutlook | None, health: str, says: str) -> None:
    prospect = prospect_of(("kinect_1", "kinect_2"), "kinect_1", seen)
    assert prospect.health == health
    assert says in prospect.sentence
    assert [node.reference for node in prospect.nodes] == [True, False]


def test_the_slider_shows_one_sensor_alone_at_each_step_and_two_between() -> None:
    assert weights(3, None) == [1.0, 1.0, 1.0]
    assert weights(3, 0.0) == [1.0, 0.0, 0.0]
    assert weights(3, 1.0) == [0.0, 1.0, 0.0]
    assert weights(3, 1.5) == [0.0, 1.0, 1.0]
    assert weights(1, 0.0) == [1.0]


def test_the_nearest_point_is_the_one_that_is_seen() -> None:
    points = np.array([[0.0, 0.0, 0.1], [0.0, 0.0, 0.0], [0.3, 0.1, 0.0]], np.float32)
    rgb = np.array([[255, 0, 0], [0, 255, 0], [0, 0, 255]], np.uint8)
    fit = fitted(extent_of([SensorCloud("a", points, points, rgb)]), Side.TOP, 80, 40)
    picture = layer(points, rgb, fit)
    u, v = np.floor(fit.pixels(points)).astype(int)[0]
    assert picture[v, u].tolist() == [255, 0, 0, 255]
    assert {tuple(one) for one in picture[picture[..., 3] > 0][:, :3].tolist()} <= {
        (255, 0, 0),
        (0, 255, 0),
        (0, 0, 255),
    }
