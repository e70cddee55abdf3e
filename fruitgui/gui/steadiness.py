"""Whether sensors that run are warm and their light is as it was: watched beside the window, said when it matters."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QCoreApplication, QObject, QTimer

from fruitgui.calibration.light_drift import LightDrift
from fruitgui.calibration.warmup import Warmth
from fruitgui.gui.connected import Connected
from fruitgui.gui.messages import Messages
from fruitgui.gui.running import Running
from fruitgui.gui.told import Telling, Told
from fruitgui.station.steadiness import Steadiness, SteadinessWatch

LOOK_MS = 5000
END_S = 5.0

translate = QCoreApplication.translate


class SensorsSteadiness(QObject):
    """Watches whatever feed is connected.

    It says once of each sensor that its light has changed, or that it still drifts while a lot is counted.
    """

    def __init__(
        self, connected: Connected, running: Running, messages: Messages, parent: QObject | None = None
    ) -> None:
        super().__init__(parent)
        self._connected = connected
        self._running = running
        self._messages = messages
        self._watch: SteadinessWatch | None = None
        self._watched: object = None
        self._ending: list[SteadinessWatch] = []
        self._said: set[tuple[str, str]] = set()
        self._look = QTimer(self, interval=LOOK_MS)
        self._look.timeout.connect(self._tell)
        connected.changed.connect(self._follow)

    def of(self, sensor: str) -> Steadiness:
        """Return how steady a sensor is."""
        return Steadiness() if self._watch is None else self._watch.of(sensor)

    def close(self) -> bool:
        """End watching; tell whether all ended in time."""
        self._stop()
        return all(watch.wait(END_S) for watch in self._ending)

    def _follow(self) -> None:
        feed = self._connected.feed
        if feed is self._watched:
            return
        self._stop()
        self._watched = feed
        if feed is not None:
            self._watch = SteadinessWatch(feed)
            self._watch.start()
            self._look.start()

    def _stop(self) -> None:
        self._look.stop()
        self._watched = None
        self._said.clear()
        self._ending = [watch for watch in self._ending if watch.running]
        if self._watch is not None:
            self._watch.stop()
            self._ending.append(self._watch)
            self._watch = None

    def _tell(self) -> None:
        feed = self._connected.feed
        for sensor in () if feed is None else feed.sensors:
            now = self.of(sensor)
            if now.light is not None and (now.light.brightness_off or now.light.white_off):
                self._say_once("light", sensor, partial(_light, sensor, now.light))
            if self._running.running and now.warmup.state is Warmth.DRIFTING:
                self._say_once("warmup", sensor, partial(_warmup, sensor))

    def _say_once(self, what: str, sensor: str, told: Telling) -> None:
        if (what, sensor) not in self._said:
            self._said.add((what, sensor))
            self._messages.warn(told)


def light_text(sensor: str, light: LightDrift) -> str:
    """Return how the light that a sensor sees on the belt has changed."""
    if light.white_off:
        text = translate("Steadiness", "The colour of the light that {sensor} sees on the belt has changed.")
    elif light.brightness > 1.0:
        text = translate("Steadiness", "The belt is much brighter for {sensor} than at first.")
    else:
        text = translate("Steadiness", "The belt is much darker for {sensor} than at first.")
    return text.format(sensor=sensor)


def _light(sensor: str, light: LightDrift) -> Told:
    remedy = translate(
        "Steadiness",
        "Kinds may be mistaken. Bring the light back, or start the sensors again so that they adjust to it.",
    )
    return Told(light_text(sensor, light), remedy)


def _warmup(sensor: str) -> Told:
    what = translate("Steadiness", "The depth of {sensor} still drifts: it warms up.").format(sensor=sensor)
    return Told(what, translate("Steadiness", "Sizes are right once it is steady; the screen “Connect” says when."))
