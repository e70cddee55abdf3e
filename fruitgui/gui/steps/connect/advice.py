"""What the screen of sensors says: what to do next. Plain words, no widgets."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QCoreApplication

from fruitgui.errors import FruitguiError
from fruitgui.gui import error_words

translate = QCoreApplication.translate


@dataclass(frozen=True, slots=True)
class SensorsNow:
    """What goes on with the sensors.

    Attributes:
        running, count: how many run, of how many.
        opening: they are being started. failure: why they could not be. still: nothing was left to run.
        over: their recording is at its end.
        counting: a lot runs. recording: they are recorded. trying: their projectors are tried.
        calibrated: they know each other and the belt.
    """

    running: int
    count: int
    opening: bool = False
    failure: FruitguiError | None = None
    still: bool = False
    over: bool = False
    counting: bool = False
    recording: bool = False
    trying: bool = False
    calibrated: bool = False

    @property
    def stopped(self) -> bool:
        """Whether they stay as they are until a person starts them again."""
        return not (self.opening or self.counting or self.recording) and (
            self.failure is not None or self.still or self.over
        )


def chooser_advice(*, chosen: bool) -> str:
    """Return what to do where a source is chosen."""
    if not chosen:
        return translate("ConnectPage", "Choose the file of a recording, or another source.")
    return translate("ConnectPage", "Choose what shall be connected, then press Connect.")


def sensors_advice(now: SensorsNow) -> str:
    """Return what to do with sensors that are connected."""
    if now.opening:
        return translate("ConnectPage", "The sensors are being started.")
    if now.counting:
        return translate("ConnectPage", "The line runs. Sensors can be changed when its lot has ended.")
    if now.recording:
        return translate(
            "ConnectPage", "The sensors are being recorded. They can be changed when the recording has ended."
        )
    if now.trying:
        return translate("ConnectPage", "The projectors are being measured; pictures come and go meanwhile.")
    if now.failure is not None:
        told = error_words.told(now.failure)
        return f"{told.what} {told.remedy}"
    if now.still:
        return translate("ConnectPage", "No sensor runs. Start them again, or connect another source.")
    if now.over:
        return translate("ConnectPage", "The recording is over. Start it again, or connect another source.")
    if now.running < now.count:
        text = translate("ConnectPage", "{running} of {count} sensors run. Look after the others, or leave them out.")
        return text.format(running=now.running, count=now.count)
    if now.calibrated:
        return translate("ConnectPage", "All sensors run, and they are calibrated.")
    if now.count == 1:
        return translate("ConnectPage", "The sensor runs. Give it a name, then calibrate.")
    text = translate("ConnectPage", "{count} sensors run. Give each a name, choose the reference, then calibrate.")
    return text.format(count=now.count)
