"""What a person does on the training screen, carried out: train, accept, keep the old, roll back."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from fruitgui.errors import FruitguiError
from fruitgui.gui.messages import Level, Message
from fruitgui.gui.queries import Queries
from fruitgui.gui.session import Session
from fruitgui.gui.steps.train.core_words import in_words
from fruitgui.gui.tasks import Job, Task
from fruitgui.gui.told import Told, Words
from fruitgui.progress import Cancelled, Progress
from fruitgui.records.models import Models, ModelVersion
from fruitgui.records.store import Store
from fruitgui.records.training import Trained, train_store
from fruitgui.station.candidate import (
    BEING_MADE,
    Candidate,
    CandidateFacts,
    forget_candidate,
    keep_candidate,
    read_candidate,
)
from fruitgui.station.fingerprint import calibration_fingerprint
from fruitgui.station.model import Model
from fruitgui.station.station import Station
from fruitgui.station.workflow_file import ModelMark
from fruitgui.station.workspace import MODELS, Workspace

SEED = 0


@dataclass(frozen=True, slots=True)
class Taken:
    """A model that is in use now: its name, and what is known of how it was trained; None for one that was before."""

    name: str
    mark: ModelMark | None


class Trainer(QObject):
    """Trains, and takes models into use; whatever takes long is done by a task.

    Attributes:
        trained: the model that was just trained and waits to be accepted, with all that is known of it; or None.
        waiting: a model that was waiting when the window was closed, or None.
        versions: all models that there are, the newest first.
        changed: one of these, or whether it trains.
    """

    changed = Signal()

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._task: Task[Trained] | None = None
        self._taking: Task[Taken] | None = None
        self.trained: Trained | None = None
        self.waiting: Candidate | None = None
        self.versions: tuple[ModelVersion, ...] = ()
        self.queries = Queries(self)
        self.queries.failed.connect(session.messages.error)

    @property
    def busy(self) -> bool:
        """Whether it trains, or takes a model into use."""
        return self._task is not None or self._taking is not None

    @property
    def in_use(self) -> ModelVersion | None:
        """The model in use, as far as it is on the list."""
        station = self._session.station
        name = None if station is None else station.model
        return next((one for one in self.versions if one.file == name), None)

    def load(self) -> None:
        """Read which models there are, and whether one waits to be accepted."""
        self.queries.ask("versions", self._session.store.models.versions, self._list)
        if self.trained is None and not self.busy and not self._session.saving:
            self.queries.ask("candidate", partial(read_candidate, self._folder), self._found)

    @property
    def _folder(self) -> Path:
        return self._session.workspace.folder / MODELS

    @property
    def _candidate(self) -> Candidate | None:
        """What waits to be accepted."""
        return self.waiting if self.trained is None else candidate_of(self.trained)

    def train(self) -> None:
        """Train on everything that is taught."""
        if self.busy:
            return
        job = training(self._session.store, self._session.workspace, self._session.station)
        self._task = self._session.tasks.run(lambda: self.tr("Training"), job, in_words)
        self._task.succeeded.connect(self._take)
        self._task.failed.connect(self._session.messages.error)
        self._task.cancelled.connect(self._stopped)
        self._task.ended.connect(self._ended)
        self.changed.emit()

    def accept(self) -> None:
        """Take the new model into use."""
        candidate, station = self._candidate, self._session.station
        if candidate is not None and station is not None and not self.busy:
            self._run(
                lambda: self.tr("Taking the model into use"), taking(self._session, candidate, station), self._accepted
            )

    def discard(self) -> None:
        """Keep the old one."""
        self.trained = self.waiting = None
        forget_candidate(self._folder)
        kept = self._session.station is not None and self._session.station.model is not None

        def told() -> Told:
            stays = self.tr("The model in use stays; the new one was put away.")
            return Told(stays if kept else self.tr("It was put away."))

        self._session.messages.info(told)
        self.load()
        self.changed.emit()

    def roll_back(self) -> None:
        """Go back to the model that was in use before this one."""
        station = self._session.station
        if station is not None and not self.busy:
            self._run(
                lambda: self.tr("Going back to the model before"), going_back(self._session, station), self._went_back
            )

    def _run(self, name: Words, job: Job[Taken], done: Callable[[Taken], None]) -> None:
        self._taking = self._session.tasks.run(name, job)
        self._taking.succeeded.connect(done)
        self._taking.failed.connect(self._session.messages.error)
        self._taking.ended.connect(self._taken)
        self.changed.emit()

    def _list(self, versions: tuple[ModelVersion, ...]) -> None:
        self.versions = versions
        self.changed.emit()

    def _found(self, candidate: Candidate | None) -> None:
        if self.trained is None and candidate is not self.waiting:
            self.waiting = candidate
            self.changed.emit()

    def _take(self, trained: Trained) -> None:
        self.trained, self.waiting = trained, None

    def _stopped(self) -> None:
        self._session.messages.info(lambda: Told(self.tr("Training was stopped; nothing was changed.")))

    def _ended(self) -> None:
        self._task = None
        self.changed.emit()

    def _accepted(self, taken: Taken) -> None:
        self.trained = self.waiting = None
        self._use(taken)
        self._session.when_saved(self._forget_accepted)
        later, before = self._session.running.running, bool(self.versions)

        def told() -> Told:
            now, next_lot = (
                self.tr("The new model is in use."),
                self.tr("The new model is in use from the next lot on."),
            )
            return Told(next_lot if later else now, action=self.tr("Roll back") if before else "")

        said = Message(Level.INFO, told, self.roll_back) if before else Message(Level.GOOD, told)
        self._say_once_saved(said)

    def _forget_accepted(self) -> None:
        """Let the model wait no more, now that the station names it: a crash before this would have lost it."""
        forget_candidate(self._folder)
        self.load()

    def _went_back(self, taken: Taken) -> None:
        self._use(taken)
        self._say_once_saved(Message(Level.GOOD, lambda: Told(self.tr("The model before is in use again."))))

    def _say_once_saved(self, said: Message) -> None:
        self._session.when_saved(partial(self._session.messages.say, said))

    def _use(self, taken: Taken) -> None:
        session = self._session
        if taken.mark is not None:
            models = {**session.marks.models, taken.name: taken.mark}
            session.save_marks(session.marks.model_copy(update={"models": models}))
        if session.station is not None:
            session.save_station(replace(session.station, model=taken.name))

    def _taken(self) -> None:
        self._taking = None
        self.load()
        self.changed.emit()


def training(store: Store, workspace: Workspace, station: Station | None) -> Job[Trained]:
    """Return the job that trains; it is the command line's."""

    def job(progress: Progress, cancelled: Cancelled) -> Trained:
        folder = workspace.folder / MODELS
        folder.mkdir(exist_ok=True)
        out = folder / BEING_MADE
        try:
            trained = train_store(store, _reads(workspace, station), out, SEED, progress, cancelled)
            keep_candidate(folder, candidate_of(trained).facts)
            return trained
        finally:
            out.unlink(missing_ok=True)

    return job


def candidate_of(trained: Trained) -> Candidate:
    """Return what is kept of a model that was just trained."""
    facts = CandidateFacts(
        taught=trained.taught, trained_on=trained.trained_on, held_out=trained.held_out, made_s=time.time()
    )
    return Candidate(trained.outcome.model, facts)


def _reads(workspace: Workspace, station: Station | None) -> Callable[[], Model | None]:
    return lambda: None if station is None else workspace.model(station).value


def taking(session: Session, candidate: Candidate, station: Station) -> Job[Taken]:
    """Return the job that writes a model beside the others, and notes that it is in use."""
    workspace, models = session.workspace, session.store.models

    def job(progress: Progress, cancelled: Cancelled) -> Taken:  # noqa: ARG001 - a file of some kilobytes
        progress(0.0, "")
        _know(models, station.model)
        file = workspace.add_model(candidate.model)
        models.use(models.add(file.name, candidate.facts.trained_on, candidate.facts.held_out))
        kinds = tuple(candidate.model.kinds.kinds)
        mark = ModelMark(calibration=calibration_fingerprint(station), taught=candidate.facts.taught, kinds=kinds)
        return Taken(file.name, mark)

    return job


def _know(models: Models, name: str | None) -> None:
    """Put a model from elsewhere on the list, so that one can go back to it."""
    versions = {one.file: one for one in models.versions()}
    if name is None:
        return
    if name not in versions:
        models.use(models.add(name, {}, {}))
    elif not versions[name].in_use:
        models.use(versions[name].key)


def going_back(session: Session, station: Station) -> Job[Taken]:
    """Return the job that goes back to the model before; where that one cannot be read, nothing is changed."""
    workspace, models = session.workspace, session.store.models

    def job(progress: Progress, cancelled: Cancelled) -> Taken:  # noqa: ARG001 - one row of a table
        progress(0.0, "")
        now = models.in_use()
        before = models.roll_back()
        kept = workspace.model(replace(station, model=before.file))
        error: FruitguiError | None = None if kept.damage is None else kept.damage.error
        if error is not None and now is not None:
            models.use(now.key)
            raise error
        return Taken(before.file, None)

    return job
