"""Small files are written beside the window, in order; what is told is on the disk, and what fails is as it was."""

from __future__ import annotations

import threading
from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from fruitgui.errors import WorldError
from fruitgui.files import read_text, written_whole
from fruitgui.gui.messages import Messages
from fruitgui.gui.saving import KeptValue, Saving
from fruitgui.gui.session import Session
from fruitgui.station.kept_file import KeptFile
from fruitgui.station.workflow_file import Marks

LONG_MS = 20_000


class Disk:
    """Writes texts when it is let; refuses those it is told to."""

    def __init__(self) -> None:
        self.free = threading.Event()
        self.free.set()
        self.refused: set[str] = set()
        self.wrote: list[tuple[str, threading.Thread]] = []

    def write(self, path: Path, text: str) -> None:
        assert self.free.wait(LONG_MS / 1e3)
        self.wrote.append((text, threading.current_thread()))
        if text in self.refused:
            raise WorldError("disk_full", "The disk is full.", "Make room.")
        with written_whole(path) as beside:
            beside.write_text(text)


@pytest.fixture
def disk() -> Disk:
    return Disk()


@pytest.fixture
def saving(qapp: object) -> Saving:  # noqa: ARG001 - timers need an application
    return Saving(Messages())


@pytest.fixture
def kept(disk: Disk, saving: Saving, tmp_path: Path) -> KeptValue[str, None]:
    return KeptValue(KeptFile(tmp_path / "some.txt", read_text, disk.write), None, saving)


def test_a_change_is_taken_at_once_and_told_once_it_is_on_the_disk(
    qtbot: QtBot, disk: Disk, saving: Saving, kept: KeptValue[str, None]
) -> None:
    told: list[str] = []
    kept.changed.connect(lambda: told.append(kept.path.read_text()))
    disk.free.clear()
    kept.put("one")
    saving.after(lambda: told.append(f"said of {kept.path.read_text()}"))
    assert kept.value == "one"
    assert saving.busy
    assert not kept.path.exists()
    disk.free.set()
    qtbot.waitUntil(lambda: not saving.busy, timeout=LONG_MS)
    assert told == ["one", "said of one"]
    assert disk.wrote[0][1] is not threading.main_thread()


def test_changes_are_written_in_their_order_and_the_newest_holds(
    qtbot: QtBot, disk: Disk, saving: Saving, kept: KeptValue[str, None]
) -> None:
    told: list[str | None] = []
    kept.changed.connect(lambda: told.append(kept.value))
    disk.free.clear()
    for text in ("one", "two", "three"):
        kept.put(text)
    disk.free.set()
    qtbot.waitUntil(lambda: not saving.busy, timeout=LONG_MS)
    assert [text for text, _ in disk.wrote] == ["one", "two", "three"]
    assert told == ["three"] * 3, "what is seen never goes back to an older change"
    kept.take_back()
    qtbot.waitUntil(lambda: not saving.busy, timeout=LONG_MS)
    assert kept.value == kept.path.read_text() == "two"


def test_what_cannot_be_written_is_said_and_is_as_it_was(
    qtbot: QtBot, disk: Disk, saving: Saving, kept: KeptValue[str, None]
) -> None:
    said: list[str] = []
    kept.put("one")
    qtbot.waitUntil(lambda: not saving.busy, timeout=LONG_MS)
    disk.refused.add("two")
    kept.put("two")
    saving.after(lambda: said.append("saved"))
    qtbot.waitUntil(lambda: not saving.busy, timeout=LONG_MS)
    assert kept.value == kept.path.read_text() == "one"
    assert [one.what for one in saving._messages.history] == ["The disk is full."]
    kept.put("three")
    saving.after(lambda: said.append("saved three"))
    qtbot.waitUntil(lambda: not saving.busy, timeout=LONG_MS)
    assert kept.value == kept.path.read_text() == "three"
    assert said == ["saved three"], "nothing is said to be saved that is not"


def test_a_failure_does_not_undo_what_was_changed_after_it(
    qtbot: QtBot, disk: Disk, saving: Saving, kept: KeptValue[str, None]
) -> None:
    disk.refused.add("one")
    disk.free.clear()
    kept.put("one")
    kept.put("two")
    disk.free.set()
    qtbot.waitUntil(lambda: not saving.busy, timeout=LONG_MS)
    assert kept.value == kept.path.read_text() == "two"


def test_nothing_is_lost_when_the_window_closes_at_once(session: Session) -> None:
    for number in range(3):
        session.save_marks(Marks(kinds=(f"kind {number}",)))
    assert session.close()
    assert not session.saving
    assert session.workspace.marks.load().value == Marks(kinds=("kind 2",))
