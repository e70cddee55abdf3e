"""What the window works on: one line's folder, what is set, and how far each step is."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from PySide6.QtCore import QObject, Signal, SignalInstance

from fruitgui.errors import WorldError
from fruitgui.gui.beginning import LinePlan
from fruitgui.gui.connected import Connected
from fruitgui.gui.kind_book import KindBook
from fruitgui.gui.line_plans import arrange_turns, line_plan, model_reader, on_station
from fruitgui.gui.lot_words import LotWords, lot_words
from fruitgui.gui.messages import Messages
from fruitgui.gui.recorder import Recorder
from fruitgui.gui.running import Running
from fruitgui.gui.saving import KeptValue, Saving
from fruitgui.gui.source_runner import SourceRunner
from fruitgui.gui.steadiness import SensorsSteadiness
from fruitgui.gui.tasks import TaskRunner
from fruitgui.gui.theme.kinds import Looks
from fruitgui.records.lot import LotPlan
from fruitgui.records.lot_search import LotQuery
from fruitgui.records.store import open_store
from fruitgui.station.connection import Connection
from fruitgui.station.depths import DeviceDepths
from fruitgui.station.facts import facts_of
from fruitgui.station.holding import hold
from fruitgui.station.kept_file import Damage, KeptFile
from fruitgui.station.kinds_file import KindNotes
from fruitgui.station.projectors import Projectors
from fruitgui.station.recordings_made import FOLDER as RECORDINGS
from fruitgui.station.settings import Settings
from fruitgui.station.sources import Sources
from fruitgui.station.station import Station
from fruitgui.station.workflow import Facts, Step, StepState, TaughtFacts, step_states
from fruitgui.station.workflow_file import Marks
from fruitgui.station.workspace import Workspace

T = TypeVar("T")
D = TypeVar("D")

LOTS_LOOKED_AT = 100


class Session(QObject):
    """The files of one line as the window holds them; every change is on the disk before it is told.

    Attributes:
        messages, tasks: the window's one voice, and its one runner of long jobs.
        connected: the sensors that run now.
        source: opens what they come from.
        recorder: records them.
        store: lots, fruit and what was taught.
        running: the line and its lot.
        kinds: what each kind looks like and weighs.
        steadiness: whether the sensors are warm, and their light is as it was.
        settings_changed, connection_changed, station_changed, projectors_changed: that file was saved.
        states_changed: a step may have another state now.
        taught_wanted: the taught fruit of a key is to be shown, on the screen where fruit get their kinds.
        damages: files that could not be read at the start; each lies aside, unharmed.
    """

    settings_changed = Signal()
    connection_changed = Signal()
    station_changed = Signal()
    projectors_changed = Signal()
    states_changed = Signal()
    taught_wanted = Signal(int)

    def __init__(self, workspace: Workspace, parent: QObject | None = None, *, sources: Sources | None = None) -> None:
        """Open the workspace's files.

        Raises:
            WorldError: another window has them, see `hold`; or the records cannot be opened, see `open_store`.
        """
        super().__init__(parent)
        self.workspace = workspace
        self.messages = Messages(self)
        self.tasks = TaskRunner(self)
        self.connected = Connected(self)
        self.source = SourceRunner(sources or Sources(), self.connected, self.tasks, self.messages, self)
        self._held = hold(workspace.folder)
        try:
            self.store = open_store(workspace.folder)
        except WorldError:
            self._held.let_go()
            raise
        self.recorder = Recorder(workspace.folder / RECORDINGS, self.connected, self.messages, self)
        self.running = Running(self.store, self.connected, self.tasks, self.messages, self)
        self.steadiness = SensorsSteadiness(self.connected, self.running, self.messages, self)
        self.damages: list[Damage] = []
        self._files: list[KeptValue[Any, Any]] = []
        self._lots = self.store.lots.find(LotQuery(count=0)).found
        self._taught = self.store.teaching.facts()
        self._saving = Saving(self.messages, self)
        files, states = workspace, self.states_changed
        self._settings = self._kept(files.settings, Settings(), self.settings_changed)
        self._connection = self._kept(files.connection, None, self.connection_changed, states)
        self._station = self._kept(files.station, None, self.station_changed, states)
        self._projectors = self._kept(files.projectors, Projectors(), self.projectors_changed)
        self._marks = self._kept(files.marks, Marks(), states)
        self._depths = self._kept(files.depths, DeviceDepths(), self.connection_changed, states)
        self._kinds = self._kept(files.kinds, KindNotes())
        self.kinds = KindBook(self._kinds.value, self._kinds.put, self)
        self._kinds.changed.connect(lambda: self.kinds.take(self._kinds.value))
        for changed in (self.connected.changed, self.station_changed, self.projectors_changed):
            changed.connect(self._arrange_turns)
        self.connected.changed.connect(self.states_changed)
        self.running.changed.connect(self._lots_changed)
        self.source.opened.connect(self._keep_connection)
        self.source.changed.connect(self.states_changed)

    @property
    def settings(self) -> Settings:
        """What a person set."""
        return self._settings.value

    @property
    def connection(self) -> Connection | None:
        """What the line is connected to."""
        return self._connection.value

    @property
    def station(self) -> Station | None:
        """What setting up made."""
        return self._station.value

    @property
    def projectors(self) -> Projectors:
        """What was measured of the sensors' projectors."""
        return self._projectors.value

    @property
    def taught(self) -> TaughtFacts | None:
        """What was taught, as far as was noted; None where nothing has a kind."""
        return self._taught

    @property
    def looks(self) -> Looks:
        """What gives each kind its mark."""
        return self.kinds.looks

    @property
    def marks(self) -> Marks:
        """Which step was done with what."""
        return self._marks.value

    @property
    def depths(self) -> DeviceDepths:
        """What was measured of the devices' depth."""
        return self._depths.value

    @property
    def saving(self) -> bool:
        """Whether a change is still on its way to the disk."""
        return self._saving.busy

    def when_saved(self, told: Callable[[], None]) -> None:
        """Call `told` once all that was changed is on the disk; never where some of it could not be saved."""
        self._saving.after(told)

    def close(self) -> bool:
        """End whatever runs, and let go of the files; an open lot stays open. Tell whether all ended in time."""
        ended = [
            self.running.close(),
            self.recorder.close(),
            self.tasks.close(),
            not self.connected.stop(),
            self.steadiness.close(),
            self._saving.finish(),
        ]
        self.store.close()
        self._held.let_go()
        return all(ended)

    def start_sensors(self) -> None:
        """Let the connection's sensors run, where there is a connection; anew where they run already."""
        if self.connection is not None:
            self.source.start(self.connection)

    def save_settings(self, settings: Settings) -> None:
        """Keep settings."""
        self._settings.put(settings)

    def save_connection(self, connection: Connection) -> None:
        """Keep what the line is connected to."""
        self._connection.put(connection)

    def save_station(self, station: Station) -> None:
        """Keep a station; the one before it can be taken back."""
        self._station.put(station)

    def take_last_good(self, damage: Damage) -> None:
        """Take back the last good state of a file that was damaged."""
        for kept in self._files:
            if kept.path == damage.file:
                kept.take_back()

    def take_back_station(self) -> None:
        """Return to the station before the last change; doing it again undoes this."""
        self._station.take_back()

    def save_projectors(self, projectors: Projectors) -> None:
        """Keep what was measured of the projectors, and go by it from now on."""
        self._projectors.put(projectors)
        self._arrange_turns()

    def save_marks(self, marks: Marks) -> None:
        """Keep which step was done with what."""
        self._marks.put(marks)

    def save_depths(self, depths: DeviceDepths) -> None:
        """Keep what was measured of the devices' depth; a station that was made otherwise is to be made again."""
        self._depths.put(depths)

    def note_taught(self, taught: TaughtFacts | None) -> None:
        """Take note of what is taught now."""
        if taught != self._taught:
            self._taught = taught
            self.states_changed.emit()

    def lot_words(self) -> LotWords:
        """Return what to propose for the next lot, by the lots that were run; not to be asked on the window's thread.

        Raises:
            WorldError: the records cannot be read.
        """
        return lot_words([line.lot for line in self.store.lots.find(LotQuery(count=LOTS_LOOKED_AT)).lots])

    def start_lot(self, plan: LotPlan) -> None:
        """Start the line on the connected sensors, and a lot."""
        station = self.station
        if station is not None:
            self.running.start_lot(self._line_plan(station), on_station(plan, station))

    def take_up_lot(self) -> None:
        """Go on with the lot that is open."""
        lot = self.running.lot
        if self.station is not None and lot is not None:
            self.running.take_up(self._line_plan(self.station), lot)

    def facts(self) -> Facts:
        """Return what exists, as far as the files tell."""
        return facts_of(
            self.connection,
            self.station,
            self.marks,
            present=self._present(),
            taught=self._taught,
            lots=self._lots,
            moved=self.running.moved,
            running=self.running.running,
            depths=self.depths,
        )

    def states(self) -> dict[Step, StepState]:
        """Return how far each step is."""
        return dict(step_states(self.facts()))

    def _present(self) -> tuple[str, ...] | None:
        """Return the sensors that are there; None while nobody looked."""
        if self.source.failure is not None and not self.source.opening:
            return ()
        feed = self.connected.feed
        return None if feed is None else feed.sensors

    def _arrange_turns(self) -> None:
        """Let the projectors take turns by what is known of the rig now."""
        if self.connected.feed is not None:
            arrange_turns(self.connected.feed, self.station, self.projectors)

    def _keep_connection(self, connection: Connection) -> None:
        if connection != self.connection:
            self.save_connection(connection)

    def _lots_changed(self) -> None:
        if self.running.lot is not None:
            self._lots = max(self._lots, 1)
        self.states_changed.emit()

    def _line_plan(self, station: Station) -> LinePlan:
        model = model_reader(self.workspace, self._saving, station)
        return line_plan(station, model, self.connection, self.source)

    def _kept(self, file: KeptFile[T], default: D, *told: SignalInstance) -> KeptValue[T, D]:
        """Return what a file holds, `default` where there is none; a damaged one is noted."""
        found = file.load()
        if found.damage is not None:
            self.damages.append(found.damage)
        value = default if found.value is None else found.value
        kept: KeptValue[T, D] = KeptValue(file, value, self._saving, self)
        for signal in told:
            kept.changed.connect(signal)
        self._files.append(kept)
        return kept
