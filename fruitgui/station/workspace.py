"""The folder that holds one line's files."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TypeVar

from fruitgui.errors import InputError, WorldError
from fruitgui.station.connection import Connection
from fruitgui.station.depths import DeviceDepths
from fruitgui.station.judging import FEATURES
from fruitgui.station.kept_file import Damage, Kept, KeptFile, set_aside
from fruitgui.station.kinds_file import NAME as KINDS
from fruitgui.station.kinds_file import KindNotes, read_kind_notes, with_typed_densities
from fruitgui.station.model import Model, read_model, write_model
from fruitgui.station.projectors import Projectors
from fruitgui.station.settings import Settings
from fruitgui.station.station import Station
from fruitgui.station.station_file import read_station, write_station
from fruitgui.station.workflow_file import Marks
from fruitgui.station.written import Written, read_written, write_written

MODELS = "models"
_MODEL = re.compile(r"model-(\d{4,9})\.fruit")

W = TypeVar("W", bound=Written)


@dataclass(frozen=True, slots=True)
class ModelFile:
    """A model as it lies in the folder: its number, and the name that a station gives it."""

    number: int
    path: Path

    @property
    def name(self) -> str:
        """The name that the station keeps: relative to the station's own file."""
        return f"{MODELS}/{self.path.name}"


class Workspace:
    """One line's folder. Made by `open_workspace`; holds no file open.

    Attributes:
        folder: where everything lies.
        settings, connection, station, projectors, marks, depths, kinds: its small files.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.settings = _written(folder / "settings.json", Settings)
        self.connection = _written(folder / "connection.json", Connection)
        self.projectors = _written(folder / "projectors.json", Projectors)
        self.marks = _written(folder / "steps.json", Marks)
        self.depths = _written(folder / "depths.json", DeviceDepths)
        self.kinds = _written(folder / KINDS, KindNotes)
        self.station: KeptFile[Station] = KeptFile(folder / "station.json", read_station, write_station)

    def models(self) -> list[ModelFile]:
        """Return the models that are there, the oldest first."""
        found = [(_MODEL.fullmatch(path.name), path) for path in (self.folder / MODELS).glob("model-*.fruit")]
        return sorted((ModelFile(int(match[1]), path) for match, path in found if match), key=lambda one: one.number)

    def add_model(self, model: Model) -> ModelFile:
        """Write a model under the next number; the station does not use it yet.

        Raises:
            WorldError: it cannot be written.
        """
        folder = _made(self.folder / MODELS)
        number = max((one.number for one in self.models()), default=0) + 1
        file = ModelFile(number, folder / f"model-{number:04d}.fruit")
        write_model(file.path, model)
        return file

    def model(self, station: Station) -> Kept[Model]:
        """Return the model that a station names, with the densities that a person typed.

        A damaged one is set aside, and the newest good one named. Densities that cannot be read are left out.
        """
        if station.model is None:
            return Kept(None)
        path = self.folder / station.model
        try:
            return Kept(with_typed_densities(read_model(path, FEATURES), self._kind_notes()))
        except InputError as error:
            aside = set_aside(path) if path.exists() and error.code != "cannot_read" else None
            return Kept(None, Damage(path, error, aside, self._newest_good(path)))

    def _kind_notes(self) -> KindNotes:
        try:
            return read_kind_notes(self.folder)
        except InputError:  # said where the file is opened for itself
            return KindNotes()

    def _newest_good(self, but: Path) -> Path | None:
        for file in reversed(self.models()):
            if file.path == but:
                continue
            try:
                read_model(file.path, FEATURES)
            except InputError:
                continue
            return file.path
        return None


def default_folder() -> Path:
    """Return where a line's files lie unless a person says otherwise."""
    import platformdirs

    return platformdirs.user_data_path("fruitgui", appauthor=False) / "line"


def open_workspace(folder: Path | None = None) -> Workspace:
    """Return the workspace in a folder, which is made where it is not there.

    Raises:
        WorldError: the folder cannot be made.
    """
    return Workspace(_made(default_folder() if folder is None else folder))


def _written(path: Path, of: type[W]) -> KeptFile[W]:
    return KeptFile(path, partial(read_written, of=of), write_written)


def _made(folder: Path) -> Path:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise WorldError(
            "cannot_write",
            f"The folder {folder} cannot be made: {error.strerror}.",
            "Name another folder, or free this one.",
            file=folder,
        ) from error
    return folder
