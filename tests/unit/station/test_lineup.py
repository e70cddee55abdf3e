from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from fruitgui.errors import InputError
from fruitgui.perception.settings import PerceptionSettings
from fruitgui.simulation.scenes import still_scene
from fruitgui.station.lineup import limits_of
from fruitgui.station.station import Station, StationSensor
from fruitgui.station.station_file import read_station, station_value, write_station


@pytest.fixture(scope="module")
def station() -> Station:
    rig = still_scene(1, "single", fruit=1).rig()
    return Station(rig.reference, {name: StationSensor("", one.pose, one.surface) for name, one in rig.mounts.items()})


def test_a_station_that_says_nothing_of_heights_has_the_usual_limits(station: Station) -> None:
    assert limits_of(station) == PerceptionSettings()


def test_small_fruit_are_looked_for_and_tall_things_left_out_where_the_station_says_so(station: Station) -> None:
    cherries = limits_of(replace(station, fruit_heights_m=(0.015, 0.03)))
    assert cherries.smallest_m == 0.015
    assert 0.03 < cherries.tallest_m < 0.05
    melons = limits_of(replace(station, fruit_heights_m=(0.1, 0.3)))
    assert melons.smallest_m == PerceptionSettings().smallest_m, "what is small is counted all the same"
    assert melons.tallest_m > 0.3


def test_heights_are_kept_in_the_station_s_file(station: Station, tmp_path: Path) -> None:
    path = tmp_path / "station.json"
    write_station(path, replace(station, fruit_heights_m=(0.04, 0.12)))
    assert read_station(path).fruit_heights_m == (0.04, 0.12)
    write_station(path, station)
    assert read_station(path).fruit_heights_m is None


@pytest.mark.parametrize("heights", [[0.1, 0.05], [0.0, 0.1], [0.1], [0.1, 3.0], ["a", "b"], 7])
def test_heights_that_cannot_be_are_refused(station: Station, tmp_path: Path, heights: object) -> None:
    value = station_value(station)
    value["belt"]["fruit_heights_m"] = heights
    path = tmp_path / "station.json"
    path.write_text(json.dumps(value), encoding="utf-8")
    with pytest.raises(InputError, match="belt"):
        read_station(path)
