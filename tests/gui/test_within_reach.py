"""Screens and dialogs in the least window: large enough for gloves, no word cut off, the keyboard everywhere, and seen.

No line runs in the walks, though one seems to; `python -m fruitgui.gui.shots` takes the screens that need one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

import pytest
from PySide6.QtWidgets import QApplication, QWidget

from fruitgui.gui.shots.documents import SIZE, scene
from fruitgui.gui.shots.stage import Stage, drawn
from fruitgui.gui.widgets import fitting
from tests.gui.reach import cut_off, focus_unseen, out_of_keyboard, rows_too_small, too_small

SCENES = (
    "connect-nothing", "connect-recorded", "connect-record", "connect-checkup-wrong", "connect-projectors-result",
    "live-staged", "live-staged-many", "teach-nothing", "train-nothing", "lots-many", "lots-fruit",
    "lots-open-corrected", "dialog-new-lot", "dialog-end-lot", "dialog-close-full", "dialog-settings-own",
    "dialog-densities-many", "trouble-backup", "trouble-none",
)  # fmt: skip

Shown = Callable[[str, str], QWidget]


@pytest.fixture(scope="module")
def stage(qapp: QApplication, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Stage]:
    made = Stage(qapp, tmp_path_factory.mktemp("stage"))
    yield made
    made.dress("dark", "en")


@pytest.fixture(params=SCENES)
def opened(request: pytest.FixtureRequest, stage: Stage) -> Iterator[Shown]:
    stage.dress("dark", "en")
    with scene(request.param).opened(stage) as window:

        def show(theme: str, language: str) -> QWidget:
            stage.dress(theme, language)
            window.resize(*SIZE)
            window.activateWindow()
            stage.settle()
            stage.wait_until(partial(drawn, window))
            stage.settle()
            return window

        yield show


def test_a_hand_in_gloves_and_a_keyboard_reach_everything(opened: Shown, monkeypatch: pytest.MonkeyPatch) -> None:
    shortened: list[str] = []

    def cut(painter: object, text: str, width: float) -> str:
        made = whole(painter, text, width)
        if made != text:
            shortened.append(text)
        return made

    whole: Callable[..., str] = fitting.cut
    monkeypatch.setattr(fitting, "cut", cut)
    for language in ("es", "en"):
        window = opened("dark", language)
        assert not too_small(window)
        assert not rows_too_small(window)
        assert not out_of_keyboard(window)
        assert not cut_off(window), language
        assert not shortened, language
    for theme in ("dark", "light"):
        assert not focus_unseen(opened(theme, "en")), theme
