"""The line while it runs, whichever screen is looked at: its lot, its state, what was counted."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TypeVar

from PySide6.QtCore import QCoreApplication, QObject, QTimer, Signal

from fruitgui.errors import FruitguiError, InputError, WorldError
from fruitgui.gui import lot_jobs
from fruitgui.gui.beginning import Begun, LinePlan, begun, source_name
from fruitgui.gui.connected import Connected
from fruitgui.gui.going_on import GoingOn
from fruitgui.gui.lot_notes import LotNotes
from fruitgui.gui.messages import Level, Message, Messages
from fruitgui.gui.queries import Queries
from fruitgui.gui.reckoning import Reckoning
from fruitgui.gui.tasks import Job, TaskRunner
from fruitgui.gui.told import Words
from fruitgui.records.lot import Lot, LotPlan
from fruitgui.records.restore import refuse_while_prepared
from fruitgui.records.set_aside import SetAside
from fruitgui.records.store import Store
from fruitgui.station.live import LineApart, LiveState, Preview

T = TypeVar("T")

translate = QCoreApplication.translate

TICK_MS = 100
CLOSE_S = 6.0


class Running(QObject):
    """Starts, pauses and ends lots; whatever takes long is done by a task.

    Attributes:
        lot: the lot that is open, or None.
        kinds: of the model that names fruit now.
        tally: what the lot amounts to.
        moved: the line saw that a sensor was moved since it was calibrated.
        changed: another lot, or none; paused or not; the line started or stopped.
        ticked: ten times a second while the line runs: `state` is new.
    """

    changed = Signal()
    ticked = Signal()

    def __init__(
        self, store: Store, connected: Connected, tasks: TaskRunner, messages: Messages, parent: QObject | None = None
    ) -> None:
        super().__init__(parent)
        self._store = store
        self._connected = connected
        self._tasks = tasks
        self._messages = messages
        self._line: LineApart | None = None
        self._aside: SetAside | None = None
        self._state: LiveState | None = None
        self._spells = Queries(self)
        self._spells.failed.connect(messages.error)
        self._notes = LotNotes(self._spells, store.spells)
        self._owed = GoingOn(store.lots, self._spells)
        self._busy = self._stopping = self._closed = False
        self._made: Begun | None = None
        self.lot: Lot | None = None
        self.kinds: tuple[str, ...] = ()
        self._reckon(Reckoning(store.lots, self._spells))
        self.moved = False
        self._tick = QTimer(self, interval=TICK_MS)
        self._tick.timeout.connect(self._look)
        connected.changed.connect(self._sensors_changed)

    @property
    def running(self) -> bool:
        """Whether the line runs, counting or not."""
        return self._line is not None

    @property
    def busy(self) -> bool:
        """Whether the lot is being started, paused, taken up or ended: until that is done, nothing else is begun."""
        return self._busy

    @property
    def stopped(self) -> bool:
        """Whether the line was stopped, but what it counted, or the lot's end, could not be kept yet."""
        return self._stopping and not self._busy

    @property
    def paused(self) -> bool:
        """Whether the lot stands still."""
        return self.lot is not None and self.lot.paused

    @property
    def state(self) -> LiveState | None:
        """How the line was at the last tick."""
        return self._state

    @property
    def unnamed(self) -> int:
        """How many unknown fruit of this run wait to be named."""
        return 0 if self._aside is None else self._aside.fruit

    @property
    def unkept(self) -> int:
        """How many fruit wait in memory because the disk takes nothing; the program's end loses them."""
        return 0 if self._line is None else self._line.state.sink.unkept

    @property
    def previews(self) -> dict[str, Preview]:
        """The newest pictures of the line."""
        return {} if self._line is None else self._line.previews

    def start_lot(self, line: LinePlan, lot: LotPlan) -> None:
        """Start the line and a lot."""
        self._begin(line, lambda: self._store.lots.start(lot))

    def take_up(self, line: LinePlan, lot: Lot) -> None:
        """Go on with a lot that was left open."""
        self._begin(line, lambda: self._store.lots.take_up(lot.key))

    def find_open_lot(self) -> None:
        """Look for a lot that was left open when the program ended; it can be taken up."""
        try:
            self.lot = self._store.lots.left_open()
        except WorldError as error:
            self._messages.error(error)
            self.lot = self._store.lots.open_lot()
        if self.lot is not None:
            self._reckon(Reckoning(self._store.lots, self._spells, self._store.lots.totals(self.lot.key)))
        self.changed.emit()

    def corrected(self, lot: int | None) -> None:
        """Count again what the records hold, where it was fruit of this lot that a person corrected."""
        if self.lot is not None and self.lot.key == lot:
            self._reckoning.read_again(lot, self.changed.emit)

    def pause(self) -> None:
        """Let fruit pass uncounted."""
        line, lot = self._line, self.lot
        if line is None or lot is None or self._busy or self._stopping:
            return
        line.count_into(None)
        self._run(_keeping, lot_jobs.pausing(self._store, lot, self._owed), self._kept)

    def resume(self) -> None:
        """Count again, though the disk may be full: fruit wait for it then."""
        line, lot, since_s = self._line, self.lot, self._store.now_s()
        if line is None or lot is None or self._busy or self._stopping:
            return
        line.count_into(lot.key)
        job = lot_jobs.resuming(self._store, lot, since_s)
        self._run(_keeping, job, self._kept, partial(self._go_on_unkept, since_s))

    def end_lot(self) -> None:
        """Stop the line, count what is in view, and end the lot; one that was left open ends as it is.

        While fruit that wait for the disk cannot be kept the lot stays open, and they wait: it can be ended later.
        """
        line, lot = self._line, self.lot
        if lot is None or self._busy:
            return
        self._stopping = line is not None
        left_open = lot_jobs.ending_left_open(self._store, lot)
        job = left_open if line is None else lot_jobs.ending(self._store, line, lot, self._owed)
        self._run(lambda: translate("Running", "Ending the lot"), job, self._ended)

    def close(self) -> bool:
        """Stop the line; the lot stays open and can be taken up again. Tell whether all was counted in time."""
        self._closed = True
        line, self._line = self._line or (None if self._made is None else self._made.line), None
        self._tick.stop()
        self._note(None)
        done = line is None or (line.stop(CLOSE_S) and lot_jobs.kept_rest(line, CLOSE_S))
        return self._spells.finish() and done

    def _begin(self, plan: LinePlan, lot: Callable[[], Lot]) -> None:
        now = self._connected.feed
        if now is None or self._line is not None or self._busy:
            return
        try:
            refuse_while_prepared(self._store.folder)
        except InputError as error:
            self._messages.error(error)
            return
        if plan.again is not None:
            self._connected.release()

        job = lot_jobs.starting(partial(begun, now, plan, self._store, lot, source_name()), self._take)
        self._run(lambda: translate("Running", "Starting the lot"), job, self._begun)

    def _take(self, made: Begun) -> None:
        self._made = made
        if self._closed:  # nobody will be told of it
            made.line.stop(0.0)

    def _begun(self, made: Begun) -> None:
        self._made = None
        self._connected.adopt(made.feed)
        self._line, self.lot, self.kinds = made.line, made.lot, made.kinds
        self._aside = made.aside
        self._notes = LotNotes(self._spells, self._store.spells)
        self._reckon(Reckoning(self._store.lots, self._spells, made.totals, made.sink))
        self._tick.start()
        self._look()
        self.changed.emit()

    def _ended(self, ended: lot_jobs.EndedLot) -> None:
        (self._look if self._tick.isActive() else self._take_counted)()
        self._line, self.lot, self._stopping = None, None, False
        self._tick.stop()
        self._messages.good(lambda: lot_jobs.ended_told(ended))
        self.changed.emit()

    def _go_on_unkept(self, since_s: float, error: FruitguiError) -> None:
        """Count on where the disk cannot take that a pause is over; it is kept with the fruit that wait."""
        if self.lot is not None and isinstance(error, WorldError):
            self._owed.owe(self.lot.key, since_s)
            self.lot = self.lot.gone_on(since_s)
        self._failed(error)

    def _left(self, lot: Lot) -> None:
        self._take_counted()
        self._line, self._stopping = None, False
        self._kept(lot)

    def _kept(self, lot: Lot) -> None:
        self.lot = lot
        self.changed.emit()

    def _run(
        self, name: Words, job: Job[T], done: Callable[[T], None], failed: Callable[[FruitguiError], None] | None = None
    ) -> None:
        self._busy = True
        task = self._tasks.run(name, job, lot_jobs.doing)
        for over in (task.succeeded, task.failed, task.cancelled):
            over.connect(self._rest)
        task.succeeded.connect(done)
        task.failed.connect(failed or self._failed)
        task.cancelled.connect(self.changed)

    def _rest(self) -> None:
        self._busy = False

    def _failed(self, error: FruitguiError) -> None:
        """Say what failed; a pause that could not be kept is none: the line does what the lot says."""
        if self._line is not None and self.lot is not None:
            self._line.count_into(None if self.lot.paused else self.lot.key)
        self._messages.error(error)
        self.changed.emit()

    def _look(self) -> None:
        """Take in what the line shows, and what was counted since."""
        if self._line is not None:
            self._state = self._line.state
            self._watch_rig(self._state)
            self._note(self._state)
            self._owed.try_again()
        self._take_counted()

    def _reckon(self, reckoning: Reckoning) -> None:
        self._reckoning, self.tally = reckoning, reckoning.tally

    def _take_counted(self) -> None:
        self._reckoning.count_kept()
        self.ticked.emit()

    def _watch_rig(self, state: LiveState) -> None:
        moved = any(warning.code == "calibration_stale" for warning in state.warnings)
        if moved != self.moved:
            self.moved = moved
            self.changed.emit()

    def _note(self, state: LiveState | None) -> None:
        if self.lot is not None:
            self._notes.note(self.lot, state)

    def _sensors_changed(self) -> None:
        """Stop the line when its sensors are taken away; the lot stays open."""
        line, lot = self._line, self.lot
        if line is None or lot is None or self._stopping:
            return
        self._stopping = True
        self._tick.stop()
        self._note(None)
        job = lot_jobs.leaving(self._store, line, lot, self._owed)
        self._run(lambda: translate("Running", "Stopping the line"), job, self._left)
        self._messages.say(Message(Level.BAD, lot_jobs.sensors_changed_told, stays=True))


def _keeping() -> str:
    return translate("Running", "Keeping the lot")
