from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fruitgui.classification.evidence import Evidence
from fruitgui.errors import InputError
from fruitgui.measurement.fruit import Quantity, Size
from fruitgui.records.labels_file import import_labels, write_labels
from fruitgui.records.store import Store, open_store
from fruitgui.records.taught import Sample, TaughtFruit
from fruitgui.records.teaching import KindCount
from fruitgui.station.labels import read_labels
from tests.unit.station.fruit_made import made_crops, made_fruit


def made_taught(number: int, source: str = "morning.mcap", views: int = 3) -> TaughtFruit:
    chance = np.random.default_rng(number)
    return TaughtFruit(
        source=source,
        source_fruit=f"track {number}",
        sensors=("kinect_1", "kinect_2"),
        evidence=Evidence(
            chance.normal(size=(views, 7)).astype(np.float32), np.array([1e-4, np.nan, 0.07]), alone=number % 2 == 0
        ),
        size=made_fruit(number).size,
        samples=tuple(
            Sample("kinect_1", number + 0.033 * at, 100.0 + 40 * at, 50.0, 20.0, at, None, at) for at in range(views)
        ),
    )


def _add(store: Store, numbers: range, source: str = "morning.mcap") -> list[int]:
    return list(store.teaching.add([(made_taught(number, source), made_crops(number)) for number in numbers]))


def test_a_taught_fruit_comes_back_exactly(store: Store) -> None:
    (key,) = _add(store, range(4, 5))
    kept, wanted = store.teaching.get(key).fruit, made_taught(4)
    np.testing.assert_array_equal(kept.evidence.view_features, wanted.evidence.view_features)
    np.testing.assert_array_equal(kept.evidence.fruit_features, wanted.evidence.fruit_features)
    assert kept.evidence.view_features.dtype == np.float32
    assert kept.evidence.alone
    assert kept.samples == wanted.samples
    assert (kept.source, kept.source_fruit, kept.sensors) == (wanted.source, wanted.source_fruit, wanted.sensors)
    assert (kept.size.volume_m3, kept.size.coverage) == (wanted.size.volume_m3, wanted.size.coverage)
    assert kept.size.edges is not None
    assert wanted.size.edges is not None
    np.testing.assert_array_equal(kept.size.edges.covariance_px2, wanted.size.edges.covariance_px2)
    assert len(store.crops.of("taught", key)) == 2


def test_a_size_that_could_not_be_measured_stays_unknown(store: Store) -> None:
    nothing = Quantity(math.nan, math.nan)
    taught = TaughtFruit("a", "1", ("k",), made_taught(1).evidence, Size(nothing, nothing, nothing, nothing, 0.1), ())
    (key,) = store.teaching.add([(taught, ())])
    size = store.teaching.get(key).fruit.size
    assert math.isnan(size.volume_m3.value)
    assert size.edges is None


def test_the_same_piece_of_fruit_is_kept_once(store: Store) -> None:
    _add(store, range(3))
    with pytest.raises(InputError) as caught:
        _add(store, range(2, 5))
    assert caught.value.code == "taught_already"
    assert store.teaching.sources() == {"morning.mcap": 3}


def test_naming_is_saved_at_once_and_counted_by_kind(store: Store, tmp_path: Path) -> None:
    keys = _add(store, range(6))
    store.teaching.name(keys[:4], "lemon", who="Ana")
    store.teaching.name(keys[4:5], "apple")
    store.teaching.measure(keys[0], 112.5, None)
    with open_store(tmp_path) as other:
        assert other.teaching.counts() == (KindCount("apple", 3, 1, 0), KindCount("lemon", 12, 4, 1))
        assert other.teaching.waiting() == 1
        assert [one.key for one in other.teaching.find("lemon")] == keys[3::-1]
        assert [one.key for one in other.teaching.find(None)] == keys[5:]


def test_steps_are_taken_back_and_done_again_even_after_a_restart(store: Store, tmp_path: Path) -> None:
    keys = _add(store, range(3))
    store.teaching.name(keys, "lemon")
    store.teaching.name(keys[:1], "apple")
    store.teaching.clear(keys[1:2])

    def kinds(of: Store) -> list[str | None]:
        return [of.teaching.get(key).fruit.kind for key in keys]

    assert kinds(store) == ["apple", None, "lemon"]
    with open_store(tmp_path) as other:
        other.teaching.undo()
        other.teaching.undo()
        assert kinds(other) == ["lemon"] * 3
        other.teaching.redo()
        assert kinds(other) == ["apple", "lemon", "lemon"]
        to_undo, to_redo = other.teaching.steps()
        assert to_undo is not None
        assert to_undo.changes[0].after == "apple"
        assert to_redo is not None
        other.teaching.name(keys[2:], "pear")
        assert other.teaching.redo() is None, "a new step ends what could be done again"
        for _ in range(5):
            other.teaching.undo()
        assert kinds(other) == [None] * 3


Deed = st.one_of(
    st.tuples(st.just("name"), st.integers(0, 3), st.sampled_from(["lemon", "apple", "pear"])),
    st.tuples(st.sampled_from(["clear", "undo", "redo"]), st.integers(0, 3), st.just("")),
)


@settings(max_examples=20, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.lists(Deed, max_size=25))
def test_undo_and_redo_go_through_the_states_as_a_list_of_them_would(
    store: Store, deeds: list[tuple[str, int, str]]
) -> None:
    source = f"recording {len(store.teaching.sources())}"
    keys = _add(store, range(4), source)
    store.teaching.name(keys, "fig")
    done: list[tuple[str | None, ...]] = [("fig",) * 4]
    undone: list[tuple[str | None, ...]] = []
    for what, at, kind in deeds:
        if what == "undo" and len(done) > 1:
            store.teaching.undo()
            undone.append(done.pop())
        elif what == "redo":
            assert (store.teaching.redo() is None) == (not undone)
            if undone:
                done.append(undone.pop())
        elif what in ("name", "clear"):
            wanted = kind if what == "name" else None
            if wanted != done[-1][at]:
                undone.clear()
                done.append((*done[-1][:at], wanted, *done[-1][at + 1 :]))
            store.teaching.change([(keys[at], "kind", wanted)])
        assert tuple(store.teaching.get(key).fruit.kind for key in keys) == done[-1]


@pytest.mark.parametrize("volume_ml", [0.0, -1.0, math.nan, math.inf])
def test_a_measure_is_above_zero(store: Store, volume_ml: float) -> None:
    (key,) = _add(store, range(1))
    with pytest.raises(InputError):
        store.teaching.measure(key, volume_ml, None)


def test_what_was_removed_is_gone_with_its_crops_and_undo_still_works(store: Store) -> None:
    keys = _add(store, range(2))
    store.teaching.name(keys, "lemon")
    store.teaching.remove(keys[:1])
    assert store.crops.of("taught", keys[0]) == ()
    store.teaching.undo()
    assert store.teaching.get(keys[1]).fruit.kind is None


def test_training_gets_what_the_command_line_would_give_it(store: Store) -> None:
    keys = _add(store, range(3))
    store.teaching.name(keys[:2], "lemon")
    store.teaching.measure(keys[0], 112.0, 120.0)
    taught = store.teaching.for_training()
    assert [(one.labelled.fruit_id, one.labelled.kind) for one in taught] == [
        ("morning.mcap:track 0", "lemon"),
        ("morning.mcap:track 1", "lemon"),
    ]
    assert taught[0].volume_m3 == pytest.approx(112e-6)
    assert taught[0].mass_kg == pytest.approx(0.12)
    assert taught[1].volume_m3 is None
    np.testing.assert_array_equal(taught[1].labelled.evidence.view_features, made_taught(1).evidence.view_features)


def test_labels_go_out_and_come_in_again(store: Store, tmp_path: Path) -> None:
    keys = _add(store, range(4))
    _add(store, range(2), "evening.mcap")
    store.teaching.name(keys[:2], "lemon")
    store.teaching.name(keys[2:3], "avocado, Chilean")
    store.teaching.measure(keys[0], 112.5, 120.25)
    path = tmp_path / "morning.csv"
    assert write_labels(store.teaching, "morning.mcap", path) == 9
    labels = read_labels(path)
    assert labels.warnings == ()
    assert labels.labels[0].time_s == made_taught(0).samples[0].time_s
    folder = tmp_path / "other"
    folder.mkdir()
    with open_store(folder) as other:
        again = _add(other, range(4))
        read = import_labels(other.teaching, "morning.mcap", path)
        assert (read.rows, read.fruit, read.warnings) == (9, 3, ())
        for ours, theirs in zip(again, keys, strict=True):
            mine, wanted = other.teaching.get(ours).fruit, store.teaching.get(theirs).fruit
            assert (mine.kind, mine.volume_ml, mine.mass_g) == (wanted.kind, wanted.volume_ml, wanted.mass_g)
        other.teaching.undo()
        assert other.teaching.waiting() == 4, "a file is one step"


def test_a_label_between_two_samples_points_at_the_fruit_and_one_beside_it_is_told(
    store: Store, tmp_path: Path
) -> None:
    (key,) = _add(store, range(1))
    path = tmp_path / "by_hand.csv"
    path.write_text(
        "sensor,time_s,u_px,v_px,kind,volume_ml\nkinect_1,0.0165,125,55,lemon,\nkinect_1,0.0165,190,55,apple,\n"
        "kinect_1,9.0,100,50,apple,\nkinect_2,0,100,50,apple,\n"
    )
    read = import_labels(store.teaching, "morning.mcap", path)
    assert (read.rows, read.fruit) == (1, 1)
    assert [warning.split(": ")[1] for warning in read.warnings] == ["line 3", "line 4", "line 5"]
    assert store.teaching.get(key).fruit.kind == "lemon"


def test_labels_that_write_a_kind_otherwise_mean_the_one_that_is_taught(store: Store, tmp_path: Path) -> None:
    keys = _add(store, range(4))
    store.teaching.name(keys[:1], "Red apple")
    path = tmp_path / "morning.csv"
    store.teaching.name(keys[1:], "x")
    write_labels(store.teaching, "morning.mcap", path)
    written = iter(["Red apple", "red_apple", "Limón", "Limo\u0301n"])
    lines = path.read_text(encoding="utf-8").splitlines()
    kinds = {fruit: next(written) for fruit in dict.fromkeys(line.split(",")[6] for line in lines[1:])}
    changed = [",".join([*(cells := line.split(","))[:4], kinds[cells[6]], *cells[5:]]) for line in lines[1:]]
    path.write_text("\n".join([lines[0], *changed]), encoding="utf-8")
    assert import_labels(store.teaching, "morning.mcap", path).fruit == 4
    assert [(one.kind, one.fruit) for one in store.teaching.counts()] == [("Limón", 2), ("Red apple", 2)]


def test_labels_of_another_recording_are_refused(store: Store, tmp_path: Path) -> None:
    _add(store, range(1))
    path = tmp_path / "wrong.csv"
    path.write_text("sensor,time_s,u_px,v_px,kind,volume_ml\nkinect_7,0.0165,125,55,lemon,\n")
    with pytest.raises(InputError) as caught:
        import_labels(store.teaching, "morning.mcap", path)
    assert caught.value.code == "no_label_matched"


def test_the_facts_tell_kinds_and_change_with_every_word(store: Store) -> None:
    assert store.teaching.facts() is None
    keys = _add(store, range(4))
    store.teaching.name(keys[:2], "lemon")
    store.teaching.name(keys[2:3], "unknown")
    first = store.teaching.facts()
    assert first is not None
    assert first.kinds == {"lemon": (6, 2)}, "what is to be rejected is no kind"
    store.teaching.measure(keys[0], 100.0, None)
    second = store.teaching.facts()
    assert second is not None
    assert second.fingerprint != first.fingerprint
    store.teaching.undo()
    assert store.teaching.facts() == first


def test_briefs_tell_what_a_grid_shows(store: Store) -> None:
    keys = _add(store, range(3))
    store.teaching.measure(keys[1], None, 99.0)
    briefs = store.teaching.briefs()
    assert [one.key for one in briefs] == keys[::-1]
    assert [one.measured for one in briefs] == [False, True, False]
    assert {one.samples for one in briefs} == {3}
    assert [one.key for one in store.teaching.unnamed()] == keys
