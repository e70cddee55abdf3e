"""The connect screen in its states."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

from PySide6.QtWidgets import QWidget

from fruitgui.gui.shots import checkups
from fruitgui.gui.shots.setting_up import SettingUp, setting_up, simulated_rig
from fruitgui.gui.shots.stage import Scene, Stage
from fruitgui.gui.steps.connect.checkup_dialog import CheckupDialog
from fruitgui.gui.steps.connect.depth.shots import SCENES as DEPTH
from fruitgui.gui.steps.connect.offers import SIMULATED
from fruitgui.gui.steps.connect.page import ConnectPage
from fruitgui.gui.steps.connect.projectors.shots import SCENES as PROJECTORS
from fruitgui.gui.steps.connect.rules_dialog import RulesDialog
from fruitgui.gui.tasks import TaskRunner
from fruitgui.progress import Cancelled, Progress
from fruitgui.sensors.feed import Running
from fruitgui.sensors.usb.machine import Machine
from fruitgui.sensors.usb.udev import rules_file
from fruitgui.station.checkup.records import Checkup
from fruitgui.station.record_state import RecordState
from fruitgui.station.sources import DeviceId, DevicesSource, Sources
from fruitgui.station.workflow import Step


def _page(on: SettingUp) -> ConnectPage:
    assert isinstance(on.page, ConnectPage)  # noqa: S101 - it was opened at this step
    return on.page


@contextmanager
def _nothing(stage: Stage, chosen: str) -> Iterator[QWidget]:
    with setting_up(stage, Step.CONNECT, simulated_rig("opposed")) as on:
        chooser = _page(on).chooser
        chooser.show_found(Sources().found())
        if chosen == SIMULATED:
            next(row for row in chooser.rows if row.offer.key == SIMULATED).click()
        else:
            chooser.take_file(Path("/data/packing/morning.mcap"))
        yield on.window


@contextmanager
def _plugged_in(stage: Stage) -> Iterator[QWidget]:
    serials = ("A00362A01234047A", "A00364813254040A", "A00367A00952052A")
    devices = DevicesSource(tuple(DeviceId("kinect", serial) for serial in serials))
    with setting_up(stage, Step.CONNECT, simulated_rig("opposed")) as on:
        _page(on).chooser.show_found([devices, *Sources().found()])
        yield on.window


@contextmanager
def _running(stage: Stage, layout: str, sensors: int) -> Iterator[QWidget]:
    with setting_up(stage, Step.CONNECT, simulated_rig(layout, sensors)) as on:
        on.connect()
        yield on.window


@contextmanager
def _silent(stage: Stage) -> Iterator[QWidget]:
    rig = simulated_rig("opposed")
    with setting_up(stage, Step.CONNECT, rig) as on:
        on.connect()
        rig.sensors[1].silent.set()
        try:
            stage.wait_until(lambda: on.session.connected.health["kinect_2"].state is Running.SILENT)
            _page(on).tiles.chosen.emit("kinect_2")
            yield on.window
        finally:
            rig.sensors[1].silent.clear()


@contextmanager
def _checkup(stage: Stage, found: Callable[[], Checkup]) -> Iterator[QWidget]:
    with _checked(stage, found) as dialog:
        yield dialog


@contextmanager
def _rules(stage: Stage) -> Iterator[QWidget]:
    with _checked(stage, checkups.much_wrong) as dialog:
        target = Path("/etc/udev/rules.d/60-fruitgui.rules")
        source = Path("/opt/fruitgui/resources/udev/60-fruitgui.rules")
        command = f"pkexec install -D -m 0644 {source} {target}"
        shown = RulesDialog(target, command, rules_file().read_text(encoding="utf-8"), dialog)
        shown.show()
        yield shown


@contextmanager
def _checked(stage: Stage, found: Callable[[], Checkup]) -> Iterator[CheckupDialog]:
    def check(progress: Progress, cancelled: Cancelled) -> Checkup:  # noqa: ARG001 - it was made before
        return found()

    tasks = TaskRunner()
    dialog = CheckupDialog(check, Machine(), tasks, stage.theme)
    dialog.show()
    stage.wait_until(lambda: not dialog.busy)
    try:
        yield dialog
    finally:
        dialog.reject()
        dialog.deleteLater()
        tasks.close()
        tasks.deleteLater()
        stage.settle()


@contextmanager
def _asked_what_to_record(stage: Stage) -> Iterator[QWidget]:
    with setting_up(stage, Step.CONNECT, simulated_rig("opposed")) as on:
        on.connect()
        recording = _page(on).recording
        recording.action.trigger()
        dialog = recording.dialog
        assert dialog is not None  # noqa: S101 - it was just asked for
        dialog.name.setText("oranges_morning")
        dialog.show_room(212_000_000_000, "/data/line_2/recordings")
        try:
            yield dialog
        finally:
            dialog.reject()


@contextmanager
def _recording(stage: Stage, silent: bool) -> Iterator[QWidget]:
    rig = simulated_rig("opposed")
    with setting_up(stage, Step.CONNECT, rig) as on:
        on.connect()
        on.session.recorder.start("oranges_morning", 300.0)
        card = _page(on).recording.card
        plan = on.session.recorder.plan
        assert plan is not None  # noqa: S101 - it was just begun
        state = RecordState(
            seconds=74.0, share=74.0 / 300.0, frames={"kinect_1": 2219, "kinect_2": 1804 if silent else 2218},
            lost={}, silent=("kinect_2",) if silent else (), bytes_written=711_000_000, parts=1,
            room_bytes=212_000_000_000, room_s=6.1 * 3600.0,
        )  # fmt: skip
        on.session.recorder.ticked.disconnect()
        card.show_recording(plan, state, stopping=False)
        yield on.window


@contextmanager
def _recorded(stage: Stage) -> Iterator[QWidget]:
    with setting_up(stage, Step.CONNECT, simulated_rig("opposed")) as on:
        folder = on.session.recorder.folder
        folder.mkdir()
        for name, made_s, size in (
            ("oranges_morning.mcap", 1.7e9, 711_000_000), ("lemons.mcap", 1.6999e9, 4_000_000_000),
            ("lemons_0002.mcap", 1.69991e9, 1_200_000_000), ("power_cut.mcap.part", 1.699e9, 84_000_000),
        ):  # fmt: skip
            (folder / name).touch()
            os.truncate(folder / name, size)  # takes no room on the disk
            os.utime(folder / name, (made_s, made_s))
        chooser = _page(on).chooser
        chooser.show_found(Sources().found())
        _page(on).entered()
        chooser.take_file(folder / "oranges_morning.mcap")
        yield on.window


SCENES: tuple[Scene, ...] = (
    Scene("connect-nothing", partial(_nothing, chosen=SIMULATED)),
    Scene("connect-devices", _plugged_in),
    Scene("connect-recording", partial(_nothing, chosen="recording")),
    Scene("connect-one", partial(_running, layout="single", sensors=1)),
    Scene("connect-two", partial(_running, layout="opposed", sensors=2)),
    Scene("connect-eight", partial(_running, layout="chain", sensors=8)),
    Scene("connect-silent", _silent),
    Scene("connect-record", _asked_what_to_record),
    Scene("connect-recording-now", partial(_recording, silent=False)),
    Scene("connect-recording-trouble", partial(_recording, silent=True)),
    Scene("connect-recorded", _recorded),
    Scene("connect-checkup-nothing", partial(_checkup, found=checkups.nothing)),
    Scene("connect-checkup-good", partial(_checkup, found=checkups.all_well)),
    Scene("connect-checkup-wrong", partial(_checkup, found=checkups.much_wrong)),
    Scene("connect-checkup-rules", _rules),
    *DEPTH,
    *PROJECTORS,
)
