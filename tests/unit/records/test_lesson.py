"""Fruit of a recording, kept to be named."""

from __future__ import annotations

from pathlib import Path

import pytest

from fruitgui.classification.evidence import UNKNOWN
from fruitgui.gui.shots.school import BEAKER_STD, LABELS, RECORDING, enrolled, name_all
from fruitgui.records.insight import look_through
from fruitgui.records.labels_file import import_labels
from fruitgui.records.lesson import watch_recording
from fruitgui.records.store import open_store
from fruitgui.station.labels import read_labels
from fruitgui.station.station_file import read_station
from tests.schools import FRUIT, nameless_school


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return name_all(enrolled(nameless_school(tmp_path_factory), tmp_path_factory.mktemp("school") / "line"))


def test_every_fruit_of_a_recording_comes_in_with_its_pictures_and_can_be_named_by_a_labels_file(folder: Path) -> None:
    with open_store(folder) as store:
        labels = read_labels(folder / LABELS).labels
        named = list(store.teaching.walk())
        assert len(named) == FRUIT
        assert sorted(one.fruit.kind or "" for one in named) == sorted(
            next(label.kind for label in labels if label.fruit == fruit) for fruit in {label.fruit for label in labels}
        )
        for one in named:
            views = [sample for sample in one.fruit.samples if sample.colour_crop is not None]
            assert views, "a view that can be shown"
            assert len(one.fruit.samples) >= one.fruit.evidence.views
            assert {crop.content for crop in store.crops.of("taught", one.key)} == {"colour", "depth", "outline"}
        measured = [one for one in named if one.fruit.volume_ml is not None]
        assert 0 < len(measured) < FRUIT
        for one in measured:
            volume = one.fruit.size.volume_m3
            assert abs(volume.value * 1e6 - one.fruit.volume_ml) < 4 * (volume.std * 1e6 + BEAKER_STD * 300)


def test_labels_of_another_sensor_or_time_name_nothing(folder: Path, tmp_path: Path) -> None:
    text = (folder / LABELS).read_text().splitlines()
    header, rows = text[0], [line.split(",") for line in text[1:]]
    moved = [",".join([row[0], f"{float(row[1]) + 900.0}", *row[2:]]) for row in rows]
    (tmp_path / "late.csv").write_text("\n".join([header, *moved]))
    with open_store(folder) as store, pytest.raises(Exception, match="No row"):
        import_labels(store.teaching, RECORDING, tmp_path / "late.csv")


def test_watching_again_adds_nothing_and_stopping_keeps_what_came_in(folder: Path, tmp_path: Path) -> None:
    station = read_station(folder / "station.json")
    with open_store(folder) as store:
        again = watch_recording(store, folder / RECORDING, station, _said, lambda _share, _doing: None, lambda: False)
        assert (again.fruit, again.known) == (0, FRUIT)
    (tmp_path / "other").mkdir()
    with open_store(tmp_path / "other") as store:
        came: list[str] = []

        def told(_share: float, doing: str) -> None:
            came.append(doing)

        lesson = watch_recording(
            store, folder / RECORDING, station, _said, told, lambda: any(not one.endswith(" 0") for one in came)
        )
        assert 0 < lesson.fruit <= FRUIT
        assert store.teaching.waiting() == lesson.fruit


def _said(frames: int, fruit: int) -> str:
    return f"{frames} {fruit}"


def test_what_is_named_teaches_what_waits(folder: Path) -> None:
    with open_store(folder) as store:
        truth = {one.key: one.kind for one in store.teaching.briefs()}
        waiting = [min(key for key, kind in truth.items() if kind == wanted) for wanted in ("lemon", "red apple")]
        store.teaching.clear(waiting)
        try:
            insight = look_through(store.teaching, 0, lambda _share, _doing: None, lambda: False)
        finally:
            store.teaching.undo()
    assert {key: guess.kind for key, guess in insight.guesses.items()} == {key: truth[key] for key in waiting}
    assert set(insight.order) == set(waiting)
    assert all(guess.kind != truth[key] for key, guess in insight.mistakes.items())
    assert UNKNOWN not in truth.values()
