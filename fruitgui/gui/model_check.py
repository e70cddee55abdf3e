"""Says when the model in use cannot be read, before a lot is to be started with it."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from pathlib import Path

from PySide6.QtCore import QObject

from fruitgui.gui import error_words
from fruitgui.gui.messages import Level, Message
from fruitgui.gui.queries import Queries
from fruitgui.gui.session import Session
from fruitgui.gui.told import Told
from fruitgui.records.models import Models
from fruitgui.station.kept_file import Damage, Kept
from fruitgui.station.model import Model
from fruitgui.station.workspace import MODELS


class ModelCheck(QObject):
    """Reads the model that the station uses, once; one that is damaged lies aside then, and another is offered."""

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._queries = Queries(self)
        self._queries.failed.connect(session.messages.error)

    def look(self) -> None:
        """Read it, on a thread of its own."""
        station = self._session.station
        if station is not None and station.model is not None:
            self._queries.ask("model", partial(self._session.workspace.model, station), self._take)

    def stop(self) -> None:
        """Wait for what is being read or written."""
        self._queries.finish()

    def _take(self, kept: Kept[Model]) -> None:
        damage = kept.damage
        if damage is not None:
            use = partial(self._use, damage.last_good)
            self._session.messages.say(Message(Level.BAD, partial(self._told, damage), use, stays=True))

    def _told(self, damage: Damage) -> Told:
        why = self.tr("No lot starts without the model that it is to name fruit by.")
        if damage.set_aside is None:
            what = self.tr("{file} cannot be read.")
        else:
            what = self.tr("{file} is damaged; it was set aside, unharmed.")
            why = f"{error_words.told(damage.error).what} {why}"
        take, without = self.tr("Take the last good one"), self.tr("Count without a model")
        return Told(what.format(file=damage.file.name), why, without if damage.last_good is None else take)

    def _use(self, path: Path | None) -> None:
        """Name fruit by another model from the next lot on, or by none."""
        name = None if path is None else f"{MODELS}/{path.name}"
        self._queries.change(partial(_noted, self._session.store.models, name), lambda _: self._used(name))

    def _used(self, name: str | None) -> None:
        session = self._session
        if session.station is not None:
            session.save_station(replace(session.station, model=name))
            session.when_saved(partial(session.messages.good, partial(self._used_told, name)))

    def _used_told(self, name: str | None) -> Told:
        if name is None:
            return Told(self.tr("Fruit count as unknown, until a model is trained and accepted."))
        return Told(self.tr("The last good model is in use."))


def _noted(models: Models, name: str | None) -> None:
    """Note which model is in use, where it is on the list of models."""
    for version in models.versions():
        if version.file == name and not version.in_use:
            models.use(version.key)
