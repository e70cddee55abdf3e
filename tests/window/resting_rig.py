"""A simulated rig whose belt is empty until someone lets it run, and an eye that knows every fruit on it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from fruitgui.frame import Frame
from fruitgui.sensors.sensor import Sensor, SensorInfo
from fruitgui.simulation.ahead import SimulatedRig
from fruitgui.simulation.motion import constant
from fruitgui.simulation.show import Show, Showing
from fruitgui.simulation.simulation import TrueFruit
from fruitgui.simulation.supply import LineOptions, crossed, supply
from fruitgui.station.sources import RECORDINGS, Connected, Make, SimulatedSource, Sources


class RestingRig:
    """A rig that was connected; its belt runs once at most.

    Attributes:
        rig: itself.
        ahead_s: by how much each sensor's stamps are ahead of the belt's own time.
    """

    def __init__(self, options: LineOptions) -> None:
        self.options = options
        self.rig = SimulatedRig(options)
        self.rig.show(Showing.EMPTY)
        self.ahead_s: dict[str, float] = {}
        show = Show(options)
        bodies = tuple(body for batch in supply(options, options.setting()) for body in batch)
        scene = replace(show.place.scene, bodies=bodies, speed=constant(options.speed_m_s), captures=())
        self._truth = show.place.showing(scene)

    def sensors(self) -> list[Sensor]:
        """Return its sensors."""
        return [_Noted(sensor, self) for sensor in self.rig.sensors()]

    def hear(self, frame: Frame) -> None:
        """Note how stamps and the belt's time go together: another sensor's frame may have come out meanwhile."""
        if self.rig.belt_s > 0.0:
            ahead_s = frame.time_s - self.rig.belt_s
            self.ahead_s[frame.sensor] = max(ahead_s, self.ahead_s.get(frame.sensor, ahead_s))

    def kind_at(self, sensor: str, time_s: float, u_px: float, v_px: float) -> str:
        """Return the kind of the fruit that is truly nearest to a place in a sensor's picture."""
        belt_s, mount = time_s - self.ahead_s[sensor], self._truth.rig_mount(sensor)
        fruit = self._truth.truth.fruit
        at_m = np.stack([self._truth.truth.position_m(one.fruit_id, belt_s) for one in fruit])
        seen_px = mount.intrinsics.project(mount.pose.inverse().apply(at_m))
        return fruit[int(np.argmin(np.linalg.norm(seen_px - (u_px, v_px), axis=1)))].kind

    def crossed(self) -> list[TrueFruit]:
        """Return what has come and gone."""
        return crossed(self.options, self.rig.belt_s)


class _Noted:
    """A sensor of the rig, which hears of its frames."""

    def __init__(self, sensor: Sensor, rig: RestingRig) -> None:
        self._sensor = sensor
        self._rig = rig

    @property
    def info(self) -> SensorInfo:
        return self._sensor.info

    def open(self) -> None:
        self._sensor.open()

    def start(self) -> None:
        self._sensor.start()

    def read(self, timeout_s: float) -> Frame:
        frame = self._sensor.read(timeout_s)
        self._rig.hear(frame)
        return frame

    def projector(self, on: bool) -> None:
        self._sensor.projector(on)

    def stop(self) -> None:
        self._sensor.stop()

    def close(self) -> None:
        self._sensor.close()


@dataclass(frozen=True, slots=True)
class RestingSource(SimulatedSource):
    """Connects a resting rig, and tells of it."""

    tell: Callable[[RestingRig], None] = field(default=lambda _: None, compare=False)

    def connect(self) -> Connected:
        """Return its sensors."""
        made = RestingRig(self.options)
        self.tell(made)
        return Connected(made.sensors(), made.rig)


class Shop:
    """The list of what can be connected: one rig, and recordings.

    Attributes:
        rigs: those that were connected, the newest last.
    """

    def __init__(self, options: LineOptions) -> None:
        self._source = RestingSource(options, "opposed", tell=self._add)
        self.rigs: list[RestingRig] = []

    def sources(self) -> Sources:
        """Return the list."""
        return Sources((Make("simulated", lambda: [self._source], self._read), RECORDINGS))

    def _add(self, rig: RestingRig) -> None:
        self.rigs.append(rig)

    def _read(self, value: Any) -> RestingSource:  # noqa: ANN401 - JSON is any
        options = value["options"]
        return replace(self._source, options=LineOptions(**{**options, "kinds": tuple(options["kinds"])}))
