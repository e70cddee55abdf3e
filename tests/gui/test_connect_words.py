from __future__ import annotations

from dataclasses import replace

import pytest
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QLabel
from pytestqt.qtbot import QtBot

from fruitgui.errors import WorldError
from fruitgui.frame import Intrinsics
from fruitgui.gui.steps.connect.arrangement import arranged
from fruitgui.gui.steps.connect.details import SensorDetails
from fruitgui.gui.steps.connect.presenter import SensorView, sensor_views, summary
from fruitgui.gui.steps.connect.tile import SensorTile
from fruitgui.gui.steps.connect.words import Condition, condition, lost_text, name_problem, rate_text
from fruitgui.gui.theme.theme import Theme
from fruitgui.sensors.feed import Running, SensorHealth
from fruitgui.sensors.sensor import SensorInfo
from fruitgui.station.connection import ConnectedSensor, Connection


def _health(state: Running = Running.RUNNING, **others: object) -> SensorHealth:
    usual = {"rate_hz": 29.8, "nominal_hz": 30.0, "frames": 1000, "drops": 0}
    return SensorHealth("kinect_1", state, **{**usual, **others})  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("health", "expected", "word"),
    [
        (_health(), "good", "running"),
        (_health(rate_hz=11.0), "warn", "slow"),
        (_health(rate_hz=11.0, frames=3), "good", "running"),
        (_health(drops=200), "warn", "loses pictures"),
        (_health(drops=3), "good", "running"),
        (_health(Running.SILENT), "bad", "no pictures"),
        (_health(Running.FAILED, error=WorldError("gone", "It is gone.", "Plug it in.")), "bad", "failed"),
        (_health(Running.ENDED), "warn", "at its end"),
        (_health(Running.STARTING), "", "starting"),
        (None, "bad", "not there"),
        (_health(Running.RUNNING, hangs=True), "bad", "does not answer"),
        (_health(Running.RUNNING, blinded_by=("kinect_2",)), "warn", "may be blinded"),
        (_health(Running.RUNNING, frames=1000, damaged=50), "warn", "loses pictures"),
        (_health(Running.RUNNING, frames=3, useless=True), "bad", "loses pictures"),
    ],
)
def test_how_a_sensor_is(health: SensorHealth | None, expected: str, word: str) -> None:
    said = condition(health)
    assert (said.health, said.word) == (expected, word)
    assert bool(said.remedy) == (expected in ("warn", "bad")), "whatever is wrong has a remedy"


def test_figures_are_said_with_what_they_are_to_be_held_against() -> None:
    assert rate_text(_health()) == "29.8 of 30.0 a second"
    assert rate_text(_health(nominal_hz=0.0)) == "29.8 a second"
    assert rate_text(_health(rate_hz=2.9, nominal_hz=2.4)) == "2.9 a second", "more than promised is no part of it"
    assert lost_text(_health()) == "none of 1\u202f000"
    assert lost_text(_health(drops=12)) == "12 of 1\u202f012"


def test_a_name_must_be_one_that_can_be_kept() -> None:
    assert name_problem("left_1", ("right",)) == ""
    for name in ("", "1st", "left side", "izquierda-1", "ñandú", "right"):
        assert name_problem(name, ("right",)), name


def test_sensors_come_in_the_order_of_the_connection_with_the_reference_marked() -> None:
    named = tuple(ConnectedSensor(device=one, name=one) for one in ("b", "a"))
    connection = Connection(source={"kind": "recording"}, sensors=named, reference="a")
    views = sensor_views(connection, {}, {}, opening=False)
    assert [(view.name, view.place, view.reference) for view in views] == [("b", 1, False), ("a", 2, True)]
    assert {view.condition.word for view in views} == {"not there"}
    assert {view.condition.word for view in sensor_views(connection, {}, {}, opening=True)} == {"starting"}
    assert summary(views) == (0, 2)
    assert sensor_views(None, {}, {}, opening=False) == ()


def test_the_firmware_stands_among_the_facts_where_it_is_known(qtbot: QtBot, theme: Theme) -> None:
    connection = Connection(source={"kind": "devices"}, sensors=(ConnectedSensor(device="a", name="a"),))
    info = SensorInfo("a", "Microsoft", "Kinect 1473", "A1", Intrinsics(640, 480, 525.0, 525.0, 319.5, 239.5), 30.0)
    details = SensorDetails(theme)
    qtbot.addWidget(details)
    details.show()
    for firmware in ("1.15", ""):
        (view,) = sensor_views(connection, {"a": replace(info, firmware=firmware)}, {}, opening=False)
        details.show_view(view, ())
        shown = [one.text() for one in details.findChildren(QLabel) if one.isVisible()]
        assert ("Firmware" in shown, "1.15" in shown) == (bool(firmware), bool(firmware))


@pytest.mark.parametrize("count", range(1, 9))
@pytest.mark.parametrize("size", [(690, 560), (1400, 880), (3300, 1900)])
def test_pictures_fit_and_stay_large_enough_to_be_seen(count: int, size: tuple[int, int]) -> None:
    fit = arranged(count, *size, around=24, words=56, gap=16, between=8)
    rows = -(-count // fit.columns)
    high = rows * (fit.pictures_height(8) + 24 + 56) + (rows - 1) * 16
    wide = fit.picture_width if fit.stacked else 2 * fit.picture_width + 8
    assert high <= size[1] + 1
    assert fit.columns * (wide + 24) + (fit.columns - 1) * 16 <= size[0] + 1
    assert fit.picture_width >= 100


@pytest.mark.parametrize(("width", "sentence"), [(160, False), (420, True)])
def test_how_many_pictures_come_stands_on_a_tile_of_any_width(
    qtbot: QtBot, theme: Theme, width: int, sentence: bool
) -> None:
    """With eight sensors in the least window there is no room for a sentence."""
    connection = Connection(source={"kind": "simulated"}, sensors=(ConnectedSensor(device="a", name="a"),))
    health = {"a": SensorHealth("a", Running.RUNNING, rate_hz=9.9, nominal_hz=10.0, age_s=0.1)}
    (view,) = sensor_views(connection, {}, health, opening=False)
    well = replace(view, condition=Condition("good", "running"))
    tile = SensorTile(theme)
    qtbot.addWidget(tile)
    tile.resize(width, 260)

    def drawn(shown: SensorView) -> QImage:
        tile.show_view(shown)
        return tile.grab().toImage()

    assert well.short_rate == "9.9/s"
    assert (drawn(well) != drawn(replace(well, rate="1.0 of 10.0 a second"))) is sentence
    assert (drawn(well) != drawn(replace(well, short_rate="1.0/s"))) is not sentence
