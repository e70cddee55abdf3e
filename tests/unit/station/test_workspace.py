"""A line's folder: whole files, the last good state beside, damaged ones named and set aside."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fruitgui.errors import InputError, WorldError
from fruitgui.geometry.plane import Plane, Surface
from fruitgui.geometry.pose import Pose
from fruitgui.station.connection import ConnectedSensor, Connection
from fruitgui.station.facts import facts_of
from fruitgui.station.fingerprint import calibration_fingerprint
from fruitgui.station.settings import Settings
from fruitgui.station.station import Station, StationSensor
from fruitgui.station.workflow import State, Step, step_states
from fruitgui.station.workflow_file import Marks
from fruitgui.station.workspace import Workspace, default_folder, open_workspace


@pytest.fixture
def workspace(tmp_path: Path) -> Workspace:
    return open_workspace(tmp_path / "line")


def station(height_m: float = 1.0, velocity: float | None = None) -> Station:
    surface = Surface(Plane(np.array([0.0, 0.0, -1.0]), height_m))
    sensor = StationSensor("A1", Pose.exact(), surface)
    return Station("left", {"left": sensor}, None if velocity is None else np.array([velocity, 0.0, 0.0]))


def connection() -> Connection:
    return Connection(source={"kind": "x"}, sensors=(ConnectedSensor(device="kinect_1", serial="A1", name="left"),))


def test_an_empty_folder_holds_nothing_and_nothing_is_wrong(workspace: Workspace) -> None:
    for file in (workspace.settings, workspace.connection, workspace.station, workspace.marks):
        kept = file.load()
        assert kept.value is None
        assert kept.damage is None
    assert workspace.models() == []


def test_what_is_written_is_read_again(workspace: Workspace) -> None:
    workspace.settings.save(Settings(language="es"))
    workspace.connection.save(connection())
    assert workspace.settings.load().value == Settings(language="es")
    assert workspace.connection.load().value == connection()


def test_fields_of_a_later_version_stay(workspace: Workspace) -> None:
    workspace.settings.path.write_text(json.dumps({"theme": "dark", "of_tomorrow": {"a": 1}}))
    settings = workspace.settings.load().value
    assert settings is not None
    workspace.settings.save(settings.model_copy(update={"language": "en"}))
    written = json.loads(workspace.settings.path.read_text())
    assert written["of_tomorrow"] == {"a": 1}
    assert (written["theme"], written["language"]) == ("dark", "en")


@pytest.mark.parametrize("text", ["{", "[]", '{"schema": "fruitgui.station/1"}', ""])
def test_a_damaged_station_is_named_kept_aside_unharmed_and_the_last_good_one_offered(
    workspace: Workspace, text: str
) -> None:
    workspace.station.save(station(1.0))
    workspace.station.save(station(1.1))
    workspace.station.path.write_text(text)
    damage = workspace.station.load().damage
    assert damage is not None
    assert damage.file == workspace.station.path
    assert damage.set_aside is not None
    assert damage.set_aside.read_text() == text
    assert damage.last_good == workspace.station.previous_path
    assert workspace.station.restore().sensors["left"].surface.plane.offset_m == 1.0
    assert workspace.station.load().value is not None


def test_a_damaged_file_never_becomes_the_last_good_one(workspace: Workspace) -> None:
    workspace.station.save(station(1.0))
    workspace.station.save(station(1.1))
    workspace.station.path.write_text("{")
    workspace.station.save(station(1.2))
    previous = workspace.station.previous()
    assert previous is not None
    assert previous.sensors["left"].surface.plane.offset_m == 1.0
    assert list(workspace.folder.glob("station.damaged-*.json"))


def test_without_a_last_good_one_none_is_offered(workspace: Workspace) -> None:
    workspace.settings.path.write_text('{"theme": "purple"}')
    damage = workspace.settings.load().damage
    assert damage is not None
    assert damage.last_good is None
    assert "theme" in str(damage.error)


def test_taking_the_last_good_one_back_can_be_undone(workspace: Workspace) -> None:
    workspace.station.save(station(1.0))
    workspace.station.save(station(1.1))
    assert workspace.station.restore().sensors["left"].surface.plane.offset_m == 1.0
    assert workspace.station.restore().sensors["left"].surface.plane.offset_m == 1.1


def test_two_damaged_files_lie_side_by_side(workspace: Workspace) -> None:
    for text in ("{1", "{2"):
        workspace.settings.path.write_text(text)
        workspace.settings.load()
    assert [path.read_text() for path in sorted(workspace.folder.glob("settings.damaged-*.json"))] == ["{1", "{2"]


def test_a_damaged_model_is_set_aside(workspace: Workspace) -> None:
    (workspace.folder / "models").mkdir()
    (workspace.folder / "models" / "model-0007.fruit").write_text("no zip")
    using = replace(station(), model=workspace.models()[0].name)
    assert using.model == "models/model-0007.fruit"
    damage = workspace.model(using).damage
    assert damage is not None
    assert damage.set_aside is not None
    assert damage.last_good is None
    assert workspace.models() == []


def test_a_folder_that_cannot_be_made_is_said(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(WorldError, match="cannot be made"):
        open_workspace(tmp_path / "file" / "line")


def test_the_usual_folder_belongs_to_the_person(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    monkeypatch.setenv("HOME", str(tmp_path))
    assert default_folder().is_relative_to(tmp_path)


@pytest.mark.parametrize("names", [("left", "left"), ("1st",), ("a b",)])
def test_names_that_cannot_be_are_refused(workspace: Workspace, names: tuple[str, ...]) -> None:
    sensors = [{"device": name, "name": name} for name in names]
    workspace.connection.path.write_text(json.dumps({"source": {}, "sensors": sensors}))
    assert workspace.connection.load().damage is not None


def test_no_previous_state_to_restore_is_an_error(workspace: Workspace) -> None:
    with pytest.raises(InputError):
        workspace.station.restore()


def test_setting_the_belt_leaves_the_calibration_what_it_was() -> None:
    assert calibration_fingerprint(station()) == calibration_fingerprint(station(velocity=0.2))
    assert calibration_fingerprint(station()) != calibration_fingerprint(station(1.01))


def test_the_files_tell_where_the_steps_are() -> None:
    made = station()
    marks = Marks(belt_calibration=calibration_fingerprint(made))
    states = step_states(facts_of(connection(), made, marks))
    assert states[Step.LIVE].state is State.READY
    moved = step_states(facts_of(connection(), station(1.2), marks))
    assert moved[Step.BELT].state is State.REDO
    gone = step_states(facts_of(connection(), made, marks, present=()))
    assert gone[Step.CONNECT].state is State.REDO
