"""What a person does on the teaching screen, carried out: seen at once, saved at once, the window never waiting."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from pathlib import Path
from typing import TypeVar

from PySide6.QtCore import QObject, QTimer, Signal

from fruitgui.errors import FruitguiError
from fruitgui.gui.queries import Queries
from fruitgui.gui.session import Session
from fruitgui.gui.steps.teach import work
from fruitgui.gui.steps.teach.classroom_words import (
    labelled_text,
    labels_text,
    left_out_told,
    named_text,
    no_step_text,
    step_text,
)
from fruitgui.gui.steps.teach.desk import Desk
from fruitgui.gui.steps.teach.lessons import Lessons
from fruitgui.gui.tasks import Job, Task
from fruitgui.gui.told import Told, Words
from fruitgui.records.correcting import checked_kind
from fruitgui.records.insight import Insight
from fruitgui.records.journal import Step
from fruitgui.records.labels_file import LabelsRead
from fruitgui.records.teaching import Brief
from fruitgui.station.workflow import TaughtFacts

log = logging.getLogger(__name__)

T = TypeVar("T")

NOTE_MS = 300
"""The other steps hear of what is taught once a person pauses; telling them costs more than naming a fruit."""

AGAIN_AFTER = 10
"""Fruit that are named before the model so far is asked again."""


class Classroom(QObject):
    """Holds the desk; every change goes to the store in order, on a thread of its own.

    Attributes:
        desk: the fruit, as they are.
        lessons: let fruit come in.
        changed: the desk.
        busy_changed: a lesson or another job began or ended.
        touched: keys of fruit that undoing or redoing changed, for the screen to show.
    """

    changed = Signal()
    busy_changed = Signal()
    touched = Signal(object)

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._teaching = session.store.teaching
        self._saving = 0
        self._named = 0
        self.lessons = Lessons(session, self)
        self.lessons.came_in.connect(self.load)
        self.lessons.changed.connect(self.busy_changed)
        self._look: Task[Insight] | None = None
        self.desk = Desk()
        self.can_undo = self.can_redo = False
        self.queries = Queries(self)
        self.queries.failed.connect(self._fail)
        self._note_soon = QTimer(self, singleShot=True, interval=NOTE_MS)
        self._note_soon.timeout.connect(self._ask_facts)

    @property
    def busy(self) -> bool:
        """Whether something is not saved, or not told to the other steps yet."""
        return self.queries.busy or self._note_soon.isActive()

    @property
    def looking(self) -> bool:
        """Whether the model so far is being asked."""
        return self._look is not None

    def load(self) -> None:
        """Read what is taught anew."""
        self.queries.ask("load", work.loading(self._session.store), self._lay_out)
        self.queries.ask("steps", self._teaching.steps, self._take_steps)

    def name(self, keys: Sequence[int], kind: str) -> None:
        """Give some fruit a kind."""
        if not keys:
            return
        try:
            kind = self.desk.add_kind(checked_kind(kind))
        except FruitguiError as error:
            self._session.messages.error(error)
            return
        self._keep_order()
        self.desk.name(keys, kind)
        self._save(lambda: self._teaching.name(keys, kind))
        self._named += len(keys)
        self._say_done(partial(named_text, len(keys), kind))
        self._look_again()

    def clear(self, keys: Sequence[int]) -> None:
        """Let some fruit wait to be named again."""
        named = [key for key in keys if self.desk.fruit[key].kind is not None]
        if named:
            self.desk.name(named, None)
            self._save(lambda: self._teaching.clear(named))
            self._say_done(lambda: self.tr("{count} fruit wait to be named again.").format(count=len(named)))

    def measure(self, key: int, volume_ml: float | None, mass_g: float | None) -> None:
        """Keep what a person measured of a fruit."""
        if key in self.desk.fruit:
            self.desk.measure(key, volume_ml, mass_g)
            self._save(lambda: self._teaching.measure(key, volume_ml, mass_g))
            self._say_done(lambda: self.tr("The measures are kept."))

    def remove(self, keys: Sequence[int]) -> None:
        """Forget some fruit for good."""
        gone = list(keys)
        self.desk.remove(gone)
        self._save(lambda: self._teaching.remove(gone))
        self._session.messages.info(lambda: Told(self.tr("{count} fruit were removed.").format(count=len(gone))))

    def undo(self) -> None:
        """Take the newest step back."""
        self._step(self._teaching.undo, back=True)

    def redo(self) -> None:
        """Do again what was taken back last."""
        self._step(self._teaching.redo, back=False)

    def look_through(self) -> None:
        """Ask the model so far: for suggestions, what to name first, likely mistakes."""
        if self._look is None and self.desk.can_look_through:
            self._named = 0
            job = work.looking_through(self._session.store, self.queries.wait_for_changes)
            self._look = self._session.tasks.run(lambda: self.tr("Looking through the fruit"), job, work.looking_words)
            self._look.succeeded.connect(self._take_insight)
            self._look.failed.connect(self._session.messages.error)
            self._look.ended.connect(self._looked)
            self.busy_changed.emit()

    def export(self, source: str, path: Path) -> None:
        """Write what is taught of a source as a labels file."""

        def told(rows: int) -> None:
            self._session.messages.good(lambda: Told(labels_text(rows, source, path.name)))

        self._run(lambda: self.tr("Writing labels"), work.exporting(self._session.store, source, path), told)

    def import_labels(self, source: str, path: Path) -> None:
        """Name the fruit of a source as a labels file says; one step, which can be taken back."""
        self._run(
            lambda: self.tr("Reading labels"), work.importing(self._session.store, source, path), self._take_labels
        )

    def sources(self, *, named: bool) -> list[str]:
        """Return where fruit come from, the newest first; only of fruit with a kind where `named`."""
        fruit = self.desk.fruit.values()
        return list(dict.fromkeys(one.source for one in fruit if one.kind is not None or not named))

    def enter(self) -> None:
        """Somebody looks: read what is taught, and go on reading while fruit come in."""
        self.load()
        self.lessons.look(True)

    def leave(self) -> None:
        """Nobody looks any more; a lesson goes on."""
        self.lessons.look(False)

    # what comes back

    def _lay_out(self, loaded: work.Loaded) -> None:
        if self._saving:
            self.load()  # something was changed meanwhile: what was read is older than what is seen
            return
        fruit, facts = loaded
        self.desk.lay_out(fruit, self.desk.order or self._kinds_of(fruit))
        self._session.note_taught(facts)
        self.changed.emit()

    def _kinds_of(self, fruit: Iterable[Brief]) -> tuple[str, ...]:
        """Return the kinds in the order of their keys, without those that no fruit has any more."""
        named = {one.kind for one in fruit}
        return tuple(kind for kind in self._session.marks.kinds if kind in named)

    def _take_steps(self, steps: tuple[Step | None, Step | None]) -> None:
        self.can_undo, self.can_redo = steps[0] is not None, steps[1] is not None
        self.changed.emit()

    def _save(self, change: Callable[[], object]) -> None:
        self._saving += 1
        self.can_undo, self.can_redo = True, False
        self.queries.change(change, self._saved)
        self.changed.emit()

    def _saved(self, _result: object) -> None:
        self._saving = max(self._saving - 1, 0)
        if not self._saving:
            self._note_soon.start()

    def _ask_facts(self) -> None:
        self.queries.ask("facts", self._teaching.facts, self._note)

    def _note(self, facts: TaughtFacts | None) -> None:
        self._session.note_taught(facts)

    def _step(self, take: Callable[[], Step | None], *, back: bool) -> None:
        self._saving += 1
        self.queries.change(take, lambda step: self._stepped(step, back=back))

    def _stepped(self, step: Step | None, *, back: bool) -> None:
        self._saved(step)
        self.queries.ask("steps", self._teaching.steps, self._take_steps)
        if step is None:
            self._session.messages.info(lambda: Told(no_step_text(back=back)))
            return
        touched = self.desk.apply(step.changes, back=back)
        self.desk.settled.difference_update(touched)
        self.changed.emit()
        self.touched.emit(touched)
        self._session.messages.info(lambda: Told(step_text(len(step.changes), back=back)))

    def _fail(self, error: FruitguiError) -> None:
        """Say it, and show again what the store really holds."""
        self._saving = 0
        self._session.messages.error(error)
        self.load()

    def _keep_order(self) -> None:
        marks = self._session.marks
        if marks.kinds != self.desk.order:
            self._session.save_marks(marks.model_copy(update={"kinds": self.desk.order}))

    def _take_insight(self, insight: Insight) -> None:
        self.desk.insight = insight
        self.desk.settled.clear()
        self.changed.emit()

    def _looked(self) -> None:
        self._look = None
        self.busy_changed.emit()

    def _look_again(self) -> None:
        """Ask anew once enough more is known, if the person has asked before."""
        if self._named >= AGAIN_AFTER and (self.desk.insight.guesses or self.desk.insight.mistakes):
            self.look_through()

    def _take_labels(self, read: LabelsRead) -> None:
        self._say_done(partial(labelled_text, read.fruit, read.rows))
        if read.warnings:
            for why in read.warnings:
                log.warning("%s", why)
            self._session.messages.warn(partial(left_out_told, len(read.warnings)))
        self.load()

    def _say_done(self, what: Words) -> None:
        """Say what was done; it can be taken back."""
        self._session.messages.info(lambda: Told(what(), action=self.tr("Undo")), self.undo)

    def _run(self, name: Words, job: Job[T], done: Callable[[T], None]) -> None:
        task = self._session.tasks.run(name, job)
        task.succeeded.connect(done)
        task.failed.connect(self._session.messages.error)
