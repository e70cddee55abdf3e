"""The training screen on a real store with fruit of a simulated line."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QAbstractButton
from pytestqt.qtbot import QtBot

from fruitgui.errors import WorldError
from fruitgui.gui.queries import Queries
from fruitgui.gui.session import Session
from fruitgui.gui.shots.school import enrolled, name_all
from fruitgui.gui.steps.train.page import TrainPage
from fruitgui.gui.theme.theme import Theme
from fruitgui.station.candidate import read_candidate
from fruitgui.station.workflow import State, Step
from fruitgui.station.workspace import MODELS
from tests.schools import FRUIT, nameless_school

LONG_MS = 180_000

pytestmark = pytest.mark.xdist_group("train page")


@pytest.fixture(scope="module")
def schoolhouse(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return name_all(enrolled(nameless_school(tmp_path_factory), tmp_path_factory.mktemp("school") / "line"))


@pytest.fixture
def page(qtbot: QtBot, taught: Session, theme: Theme) -> Iterator[TrainPage]:
    made = TrainPage(taught, theme)
    made.resize(1072, 580)
    made.show()
    made.entered()
    _rest(qtbot, made)
    yield made
    made.left()
    _rest(qtbot, made)
    made.close()
    made.deleteLater()


def _rest(qtbot: QtBot, page: TrainPage) -> None:
    qtbot.waitUntil(
        lambda: not page.trainer.busy and not any(one.busy for one in page.findChildren(Queries)), timeout=LONG_MS
    )


def _train(qtbot: QtBot, page: TrainPage) -> None:
    page.train.trigger()
    qtbot.waitUntil(lambda: not page.trainer.busy, timeout=LONG_MS)
    assert page.trainer.trained is not None


def _accept(qtbot: QtBot, page: TrainPage) -> None:
    page.accept.trigger()
    _rest(qtbot, page)


def _teach_wrong(session: Session) -> int:
    """Give one lemon a wrong kind; return its key."""
    key = max(one.key for one in session.store.teaching.briefs() if one.kind == "lemon")
    session.store.teaching.name([key], "red apple")
    session.note_taught(session.store.teaching.facts())
    return key


def test_without_labels_it_says_where_to_go(session: Session, theme: Theme, qtbot: QtBot) -> None:
    page = TrainPage(session, theme)
    qtbot.addWidget(page)
    page.show()
    qtbot.waitUntil(lambda: not page.trainer.queries.busy)
    wanted: list[object] = []
    page.step_wanted.connect(wanted.append)
    assert page.empty.isVisible()
    assert page.main_action is page.way_to(Step.TEACH)
    page.way_to(Step.TEACH).trigger()
    assert wanted == [Step.TEACH]


def test_one_press_trains_and_nothing_changes_before_it_is_accepted(
    qtbot: QtBot, taught: Session, page: TrainPage
) -> None:
    assert page.start.isVisible()
    assert "Lemon" in page.start.warning.text(), "few fruit are said"
    assert page.main_action is page.train
    _train(qtbot, page)
    assert page.result.isVisible()
    assert page.result.matrix.accessibleDescription().startswith("Lemon: ")
    assert page.result.figure.text().endswith("%")
    assert page.result.rivals.isHidden(), "there is no model to compare with"
    assert "reference" not in page.result.volume_words.text()
    assert page.result.densities.count() == 4, "two kinds and their densities"
    assert taught.station is not None
    assert taught.station.model is None
    assert taught.workspace.models() == []


def test_accepting_takes_the_model_into_use_and_the_steps_follow(
    qtbot: QtBot, taught: Session, page: TrainPage
) -> None:
    _train(qtbot, page)
    _accept(qtbot, page)
    assert taught.station is not None
    assert taught.station.model == "models/model-0001.fruit"
    taught.kinds.type_densities({"lemon": 0.5})
    qtbot.waitUntil(lambda: not taught.saving)
    model = taught.workspace.model(taught.station).value
    assert model is not None
    assert model.correction.densities["lemon"].value == 500.0, "what a person typed"
    (other,) = set(model.correction.densities) - {"lemon"}
    assert 900.0 < model.correction.densities[other].value < 1100.0, "what reference fruit taught"
    state = taught.states()[Step.TRAIN]
    assert (state.state, state.remarks) == (State.DONE, ())
    version = taught.store.models.in_use()
    assert version is not None
    assert version.file == taught.station.model
    assert page.main_action is page.way_to(Step.LIVE)
    _teach_wrong(taught)
    assert [why.code for why in taught.states()[Step.TRAIN].remarks] == ["taught_since"]
    assert page.main_action is page.train


def test_a_model_that_was_not_accepted_is_offered_again_after_closing(
    qtbot: QtBot, taught: Session, page: TrainPage, theme: Theme
) -> None:
    _train(qtbot, page)
    again = TrainPage(taught, theme)
    qtbot.addWidget(again)
    again.show()
    _rest(qtbot, again)
    assert again.trainer.waiting is not None
    assert again.start.waiting.isVisible()
    assert "%" in again.start.waiting.text()
    assert again.main_action is again.accept
    _accept(qtbot, again)
    assert again.trainer.waiting is None
    assert taught.station is not None
    assert taught.station.model == "models/model-0001.fruit"
    assert taught.workspace.model(taught.station).value is not None
    assert taught.states()[Step.TRAIN].state is State.DONE
    qtbot.waitUntil(lambda: not taught.saving)
    assert [path.name for path in (taught.workspace.folder / MODELS).iterdir()] == ["model-0001.fruit"]


def test_a_model_that_was_accepted_waits_on_where_the_station_could_not_be_written(
    qtbot: QtBot, taught: Session, page: TrainPage, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(_station: object) -> None:
        raise WorldError("disk_full", "The disk is full.", "Make room.")

    _train(qtbot, page)
    with monkeypatch.context() as disk:
        disk.setattr(taught.workspace.station, "save", full)
        _accept(qtbot, page)
        qtbot.waitUntil(lambda: not taught.saving)
    assert taught.station is not None
    assert taught.station.model is None
    page.entered()
    qtbot.waitUntil(lambda: page.trainer.waiting is not None)
    _accept(qtbot, page)
    qtbot.waitUntil(lambda: not taught.saving)
    assert taught.station.model is not None
    assert read_candidate(taught.workspace.folder / MODELS) is None


def test_a_waiting_model_that_cannot_be_read_is_not_offered(qtbot: QtBot, taught: Session, theme: Theme) -> None:
    folder = taught.workspace.folder / MODELS
    folder.mkdir(exist_ok=True)
    (folder / "candidate.json").write_text("{}")
    (folder / "candidate.fruit").write_bytes(b"half a model")
    page = TrainPage(taught, theme)
    qtbot.addWidget(page)
    page.show()
    _rest(qtbot, page)
    assert page.trainer.waiting is None
    assert page.main_action is page.train


def test_a_second_model_is_compared_on_the_same_fruit_and_can_be_rolled_back(
    qtbot: QtBot, taught: Session, page: TrainPage
) -> None:
    _train(qtbot, page)
    _accept(qtbot, page)
    _train(qtbot, page)
    assert page.trainer.trained is not None
    rivals = page.trainer.trained.rivals
    assert rivals is not None
    assert (rivals.comparison.fruit, rivals.seen) == (FRUIT, FRUIT)
    assert "flatters it" in page.result.rivals.text()
    _accept(qtbot, page)
    assert taught.station is not None
    assert taught.station.model == "models/model-0002.fruit"
    page.back.trigger()
    _rest(qtbot, page)
    assert taught.station.model == "models/model-0001.fruit"
    assert taught.workspace.station.load().value is not None
    version = page.trainer.in_use
    assert version is not None
    assert version.file == "models/model-0001.fruit"
    page.back.trigger()
    _rest(qtbot, page)
    assert "No model was in use before" in taught.messages.history[-1].what
    assert taught.station.model == "models/model-0001.fruit"


def test_the_old_model_is_kept_when_a_person_says_so(qtbot: QtBot, taught: Session, page: TrainPage) -> None:
    _train(qtbot, page)
    page.discard.trigger()
    _rest(qtbot, page)
    assert page.trainer.waiting is None
    assert page.start.isVisible()
    assert taught.station is not None
    assert taught.station.model is None
    assert taught.store.models.versions() == ()


def test_a_mistake_leads_back_to_its_label(qtbot: QtBot, taught: Session, page: TrainPage) -> None:
    key = _teach_wrong(taught)
    _train(qtbot, page)
    page.result.turn_to("mistakes")
    assert key in page.result.mistakes.model.keys
    page.result.mistakes.grid.choose_row(page.result.mistakes.model.row(key))
    tile = page.result.mistakes.tile(key)
    assert tile.words.startswith("Red apple, taken for ")
    asked: list[object] = []
    page.step_wanted.connect(asked.append)
    taught.taught_wanted.connect(asked.append)
    assert page.look in page.other_actions
    qtbot.keyClick(page.result.mistakes.grid, Qt.Key.Key_Return)
    assert asked == [Step.TEACH, key]


def test_training_can_be_stopped(qtbot: QtBot, taught: Session, page: TrainPage) -> None:
    page.train.trigger()
    qtbot.waitUntil(lambda: bool(taught.tasks.running))
    assert not page.train.isEnabled()
    taught.tasks.running[0].cancel()
    qtbot.waitUntil(lambda: not page.trainer.busy, timeout=LONG_MS)
    assert page.trainer.trained is None
    assert page.start.isVisible()
    assert "stopped" in taught.messages.history[-1].what


def test_everything_that_is_pressed_is_large_enough_for_a_glove(qtbot: QtBot, page: TrainPage) -> None:
    _train(qtbot, page)
    for one in page.findChildren(QAbstractButton):
        if one.isVisible():
            assert min(one.width(), one.height()) >= 40, one.text()
    qtbot.keyClick(page, Qt.Key.Key_3, Qt.KeyboardModifier.ControlModifier)
    assert page.result.shown == "curve"
    assert page.result.curve.grab().toImage() != page.result.volume.grab().toImage()
