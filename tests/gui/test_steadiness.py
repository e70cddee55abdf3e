"""What the window says of light that changes, and of sensors that drift while a lot is counted."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import pytest
from pytestqt.qtbot import QtBot

from fruitgui.calibration.light_drift import LightDrift
from fruitgui.calibration.warmup import Warmth, Warmup
from fruitgui.gui.session import Session
from fruitgui.gui.shots.depth_bench import frozen_bench
from fruitgui.gui.shots.frozen import frozen_sources
from fruitgui.gui.steadiness import light_text
from fruitgui.station.steadiness import Steadiness
from fruitgui.station.workspace import open_workspace

DARK = LightDrift(0.4, 1.0, 1.0)
DRIFTS = Warmup(Warmth.DRIFTING, 500.0, 0.0, 0.001, 1e-5)


def test_it_is_said_once_of_each_sensor(qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    bench = frozen_bench()
    session = Session(open_workspace(tmp_path / "line"), sources=frozen_sources(bench.source))
    session.source.choose(bench.source)
    qtbot.waitUntil(lambda: session.connected.feed is not None, timeout=60_000)
    said = session.messages.history
    steadiness = session.steadiness
    assert steadiness.of("kinect_1") == Steadiness(), "nothing is known at once"
    monkeypatch.setattr(steadiness, "_watch", SimpleNamespace(
        of=lambda _sensor: Steadiness(DRIFTS, DARK), stop=steadiness._watch.stop, wait=steadiness._watch.wait,  # type: ignore[union-attr]
    ))  # fmt: skip
    before = len(said)
    steadiness._tell()
    steadiness._tell()
    told = session.messages.history[before:]
    assert [one.what for one in told] == [light_text("kinect_1", DARK)], "drifting matters while a lot is counted"
    assert told[0].remedy
    monkeypatch.setattr(type(session.running), "running", property(lambda _self: True))
    steadiness._tell()
    steadiness._tell()
    assert len(session.messages.history) == before + 2
    monkeypatch.undo()
    assert session.close()
    qtbot.waitUntil(lambda: not session.tasks.running)
    session.deleteLater()


@pytest.mark.parametrize(
    ("drift", "word"),
    [(DARK, "darker"), (LightDrift(2.0, 1.0, 1.0), "brighter"), (LightDrift(1.0, 1.3, 0.8), "colour")],
)
def test_words_of_light(drift: LightDrift, word: str) -> None:
    assert word in light_text("left", drift)
    assert "left" in light_text("left", drift)
