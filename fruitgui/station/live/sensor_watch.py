"""Watches whether the line's sensors give something, and says what nobody sees while they do not."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Mapping

from fruitgui.frame import F64
from fruitgui.sensors.feed import Running, SensorHealth
from fruitgui.sensors.sensor import SensorTimeoutError
from fruitgui.station.live.above import FromAbove
from fruitgui.station.live.blind import Blind, blind_part, blind_words
from fruitgui.station.live.sparse import SparseWatch

LOOK_S = 0.2


class SensorWatch:
    """Looks at the sensors' health now and then, on the thread that calls, and at when frames were taken.

    Args:
        station_id: by the sensors' ids in the feed.
        above: the belt from above, as it is known by now.
        away: states in which a sensor gives nothing though it should.
        warn: told of what a person should know: code, text, sensors.

    Attributes:
        blind: what is not seen now; None while every sensor is there.
    """

    def __init__(
        self,
        station_id: Mapping[str, str],
        above: FromAbove,
        away: Collection[Running],
        warn: Callable[[str, str, tuple[str, ...]], None],
    ) -> None:
        self._station_id = station_id
        self._above = above
        self._counts_as_away = away
        self._warn = warn
        self._looked_s = 0.0
        self._away: tuple[str, ...] = ()
        self._blinded: dict[str, tuple[str, ...]] = {}
        self._leaps: dict[str, int] = {}
        self.blind: Blind | None = None
        self._absences: Counter[str] = Counter()
        self._often = SparseWatch(station_id.values(), above, warn)

    @property
    def sparse(self) -> Blind | None:
        """What is not seen often enough now; None while every sensor that is there gives enough pictures."""
        blind = self.blind
        return self._often.now(() if blind is None else blind.sensors)

    def see(self, name: str, time_s: float, velocity_m_s: F64 | None) -> None:
        """Note that a frame was followed, see `SparseWatch`. May be another thread than that which looks."""
        self._often.see(name, time_s, velocity_m_s, self._absences)

    def look(self, health: Callable[[str], SensorHealth], now_s: float) -> None:
        """Look at the health of each sensor, if the last look was a while ago."""
        if now_s - self._looked_s < LOOK_S:
            return
        self._looked_s = now_s
        seen = {name: health(sensor) for sensor, name in self._station_id.items()}
        self._see_away(tuple(name for name, one in seen.items() if self._is_away(one)))
        for name, one in seen.items():
            self._see_blinded(name, one)
            self._see_leaps(name, one)

    def _is_away(self, health: SensorHealth) -> bool:
        if Running.SILENT in self._counts_as_away:
            return health.state in self._counts_as_away or health.hangs or health.useless
        # One that is opened again after a long silence has failed by silence, which tells nothing.
        return health.state in self._counts_as_away and not isinstance(health.error, SensorTimeoutError)

    def _see_away(self, away: tuple[str, ...]) -> None:
        before, self._away = self._away, away
        self._absences.update(set(away) - set(before))
        self.blind = self._blind(away)
        if self.blind is not None and not set(away) <= set(before):
            code = "part_blind" if self.blind.loses_fruit else "sensor_away"
            self._warn(code, blind_words(self.blind), away)

    def _blind(self, away: tuple[str, ...]) -> Blind | None:
        """Return what is not seen, worked out anew only where sensors or the way of the belt changed."""
        if not away:
            return None
        now, along = self.blind, self._above.along
        if now is not None and now.sensors == away and (now.lanes_m is not None) == along:
            return now
        return blind_part(self._above.footprints_m, away, along=along)

    def _see_blinded(self, name: str, health: SensorHealth) -> None:
        by = tuple(self._station_id.get(sensor, sensor) for sensor in health.blinded_by)
        if by and by != self._blinded.get(name):
            others = ", ".join(by)
            text = f"The driver of sensor {others} hangs, and its projector may still be on: depth of sensor {name} "
            text += "may have holes, and sizes may be wrong. Unplug it; it is opened again when it returns."
            self._warn("may_be_blinded", text, (name, *by))
        self._blinded[name] = by

    def _see_leaps(self, name: str, health: SensorHealth) -> None:
        """Say each leap of a device's clock; those before the line began are nothing to it."""
        for _ in range(health.clock_leaps - self._leaps.get(name, health.clock_leaps)):
            text = f"The clock of sensor {name} leapt; its times go on by this computer's clock."
            self._warn("clock_jumped", text, (name,))
        self._leaps[name] = health.clock_leaps
