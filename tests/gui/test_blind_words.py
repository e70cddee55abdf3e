"""What nobody sees of the belt is said on the live screen, in messages, and in both languages."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from fruitgui.gui.blind_words import blind_remedy, blind_text, sparse_remedy, sparse_text
from fruitgui.gui.drawn import BeltMap
from fruitgui.gui.health import warning_message
from fruitgui.gui.messages import Level
from fruitgui.gui.steps.live.belt_map import BeltView
from fruitgui.gui.steps.live.presenter import Marks, belt_map, health_words
from fruitgui.gui.theme.theme import Theme
from fruitgui.sensors.feed import Running, SensorHealth
from fruitgui.station.live.blind import Blind
from fruitgui.station.live.state import LiveState, LiveWarning, Phase

LEFT = Blind(("kinect_1",), ((0.41, 0.65),), 0.65, 0.4)
NOTHING_LOST = Blind(("kinect_1",), (), 0.65, 0.2)
CORNERS = np.array([[0.0, 0.0], [0.8, 0.0], [0.8, 0.4], [0.0, 0.4]])


@pytest.mark.usefixtures("qapp")
@pytest.mark.parametrize(
    ("blind", "words"),
    [
        (LEFT, ("kinect_1 away", "left part of the belt", "0.41–0.65", "right edge")),
        (Blind(("a", "b"), ((0.0, 0.65),), 0.65, 1.0), ("a, b away", "no sensor sees any of the belt")),
        (Blind(("a",), ((0.0, 0.2), (0.5, 0.65)), 0.65, 0.5), ("right part", "left part")),
        (Blind(("a",), None, None, 0.4), ("40", "of the belt is seen by no sensor")),
        (Blind(("a",), None, None, 0.996), ("99", "of the belt is seen by no sensor")),
        (Blind(("a",), None, None, 0.004), ("1", "of the belt is seen by no sensor")),
        (NOTHING_LOST, ("still seen by another",)),
    ],
)
def test_what_is_blind_is_said(blind: Blind, words: tuple[str, ...]) -> None:
    text = blind_text(blind)
    assert all(word in text for word in words), text
    assert ("not counted" in blind_remedy(blind)) == blind.loses_fruit


@pytest.mark.usefixtures("qapp")
@pytest.mark.parametrize(
    ("sparse", "words"),
    [
        (LEFT, ("kinect_1: too few pictures", "no other sensor sees the left part of the belt", "0.41–0.65")),
        (Blind(("a",), None, None, 0.4), ("40", "of the belt")),
        (NOTHING_LOST, ("another sensor sees every part",)),
    ],
)
def test_what_is_seen_too_seldom_is_said(sparse: Blind, words: tuple[str, ...]) -> None:
    text = sparse_text(sparse)
    assert all(word in text for word in words), text
    assert ("may be missed" in sparse_remedy(sparse)) == sparse.loses_fruit
    message = warning_message(LiveWarning("part_sparse", "…", sparse.sensors), sparse)
    assert message.level is (Level.BAD if sparse.loses_fruit else Level.WARN)
    assert message.what == f"{text}."
    late = warning_message(LiveWarning("part_sparse", "…", sparse.sensors), None)
    assert "Too few pictures" in late.what


@pytest.mark.usefixtures("qapp")
def test_a_message_names_the_part_and_what_it_means() -> None:
    message = warning_message(LiveWarning("part_blind", "…", ("kinect_1",)), LEFT)
    assert message.level is Level.BAD
    assert "left part of the belt" in message.what
    assert "not counted" in message.remedy
    assert warning_message(LiveWarning("sensor_away", "…", ("kinect_1",)), NOTHING_LOST).level is Level.WARN
    late = warning_message(LiveWarning("part_blind", "…", ("kinect_1",)), None)
    assert "kinect_1" in late.what
    blinded = warning_message(LiveWarning("may_be_blinded", "…", ("kinect_1", "kinect_2")))
    assert "kinect_1, kinect_2" in blinded.what


def test_the_belt_shows_who_is_away_and_says_it(qtbot: QtBot, theme: Theme, qapp: QApplication) -> None:  # noqa: ARG001
    state = LiveState(Phase.RUNNING, footprints_m={"kinect_1": CORNERS, "kinect_2": CORNERS}, blind=LEFT)
    drawn = belt_map(state, Marks())
    assert drawn.blind == {"kinect_1"}
    assert drawn.lost
    view = BeltView(theme)
    qtbot.addWidget(view)
    view.resize(600, 200)
    view.show_map(BeltMap(drawn.footprints_m, drawn.blind, (), 0.2))
    without = view.grab().toImage()
    view.show_map(drawn)
    assert view.grab().toImage() != without


@pytest.mark.usefixtures("qapp")
def test_a_driver_that_hangs_is_said_beside_its_picture() -> None:
    assert health_words(SensorHealth("a", Running.RUNNING, hangs=True)) == ("bad", "does not answer")
    assert health_words(SensorHealth("a", Running.RUNNING, useless=True)) == ("bad", "loses pictures")
    assert health_words(SensorHealth("a", Running.RUNNING, blinded_by=("b",))) == ("warn", "may be blinded")
