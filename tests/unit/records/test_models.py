from __future__ import annotations

import pytest

from fruitgui.errors import InputError
from fruitgui.records.store import Store
from tests.unit.records.conftest import Clock


def test_models_are_taken_into_use_and_rolled_back_one_by_one(store: Store) -> None:
    assert store.models.in_use() is None
    keys = [store.models.add(f"models/model-{at:04d}.fruit", {"kinds": ["lemon"]}, {"right": 0.9}) for at in (1, 2, 3)]
    for key in keys:
        store.models.use(key)
    store.models.use(keys[2])
    assert [one.in_use for one in store.models.versions()] == [True, False, False]
    assert [store.models.roll_back().key for _ in range(2)] == [keys[1], keys[0]]
    with pytest.raises(InputError):
        store.models.roll_back()
    store.models.use(keys[2])
    assert store.models.roll_back().key == keys[0]
    version = store.models.in_use()
    assert version is not None
    assert (version.file, version.trained_on, version.held_out) == (
        "models/model-0001.fruit",
        {"kinds": ["lemon"]},
        {"right": 0.9},
    )


def test_one_file_is_one_version(store: Store) -> None:
    store.models.add("a.fruit", {}, {})
    with pytest.raises(InputError):
        store.models.add("a.fruit", {}, {})
    with pytest.raises(InputError):
        store.models.use(99)


def test_settings_remember_what_they_were(store: Store, clock: Clock) -> None:
    store.settings.note("crop_days", 30, "Ana")
    clock.now_s += 60
    store.settings.note("crop_days", 30)
    store.settings.note("crop_days", {"colour": 7, "depth": None})
    store.settings.note("theme", "dark")
    assert [(one.value, one.who) for one in store.settings.of("crop_days")] == [
        ({"colour": 7, "depth": None}, ""),
        (30, "Ana"),
    ]
