"""A simulated line whose fruit were taught: what the screens that teach and train are drawn and tested with."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path

from fruitgui.progress import never_cancelled, no_progress
from fruitgui.records.labels_file import import_labels
from fruitgui.records.lesson import watch_recording
from fruitgui.records.store import Store, open_store
from fruitgui.simulation.labels import truth_labels, write_labels
from fruitgui.simulation.scenes import line_scene
from fruitgui.simulation.simulation import Simulation
from fruitgui.station.record_simulated import record_simulation
from fruitgui.station.station import Station, StationSensor
from fruitgui.station.station_file import write_station

RECORDING, LABELS = "line.mcap", "labels.csv"
MEASURED_SHARE = 0.5
BEAKER_STD = 0.01


def school(folder: Path, simulation: Simulation, *, named: bool = True) -> Path:
    """Make a workspace of a line whose fruit came in, each with its true kind where `named`; return its folder.

    Beside the store lie the recording and a labels file of the truth.
    """
    folder.mkdir(parents=True)
    record_simulation(simulation, folder / RECORDING)
    station = true_station(simulation)
    write_station(folder / "station.json", station)
    labels = truth_labels(simulation, volume_share=MEASURED_SHARE, beaker_std=BEAKER_STD)
    write_labels(folder / LABELS, [replace(one, kind=one.kind.replace("_", " ")) for one in labels])
    with open_store(folder) as store:
        watch_recording(store, folder / RECORDING, station, lambda _frames, _fruit: "", no_progress, never_cancelled)
    return name_all(folder) if named else folder


def name_all(folder: Path) -> Path:
    """Name all fruit of a school by its labels file, and weigh what was measured; return its folder."""
    with open_store(folder) as store:
        import_labels(store.teaching, RECORDING, folder / LABELS)
        weigh(store)
    return folder


def weigh(store: Store) -> None:
    """Weigh the fruit of which the volume was measured."""
    for one in store.teaching.briefs():
        if one.volume_ml is not None:
            store.teaching.measure(one.key, one.volume_ml, round(one.volume_ml * 0.93, 1))


def true_station(simulation: Simulation) -> Station:
    """Return the station that a perfect calibration would give."""
    sensors = {
        name: StationSensor(simulation.device(name).serial, mount.pose, mount.surface)
        for name, mount in simulation.rig().mounts.items()
    }
    return Station(simulation.rig().reference, sensors)


def enrolled(school_folder: Path, into: Path) -> Path:
    """Return a copy of a school, to be changed at will."""
    shutil.copytree(school_folder, into)
    return into


def large_class(fruit: int = 48) -> Simulation:
    """Return a line of the five usual kinds before two sensors."""
    return line_scene(11, fruit=fruit, speed_m_s=0.25)
