"""From the line's state to what the live screen draws; no widgets."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from PySide6.QtCore import QCoreApplication

from fruitgui.classification.evidence import UNKNOWN
from fruitgui.frame import F64
from fruitgui.gui.blind_words import blind_text
from fruitgui.gui.drawn import (
    BeltMap,
    DrawnFruit,
    DrawnPicture,
    KindLine,
    LastFruit,
    MappedFruit,
)
from fruitgui.gui.kind_words import kind_name
from fruitgui.gui.numbers import measured_text, number_text, percent_text
from fruitgui.gui.steps.live.tally import Histogram, KindSum, Tally
from fruitgui.gui.theme.kinds import KindMark, Looks, kind_marks
from fruitgui.gui.times import duration_text
from fruitgui.gui.widgets.histogram import Bars
from fruitgui.sensors.feed import Running, SensorHealth
from fruitgui.station.live.state import Finished, LiveState, Opinion, Pictured, Preview, TrackNow
from fruitgui.station.report import ML_PER_M3
from fruitgui.station.sink import CountedFruit

ML_PER_L = 1e3

HALF_95 = 1.96
"""Standard deviations that the half width of a 95 % interval is."""


@dataclass(slots=True)
class Marks:
    """The marks of all kinds seen, in the order of the model's kinds; new ones are added as they come."""

    looks: Looks = kind_marks
    kinds: list[str] = field(default_factory=list)
    _marks: dict[str, KindMark] = field(default_factory=dict)

    def of(self, kind: str) -> KindMark:
        """Return a kind's mark."""
        if kind not in self._marks:
            if kind != UNKNOWN and kind not in self.kinds:
                self.kinds.append(kind)
            self._marks = self.looks(self.kinds)
        return self._marks[kind]


def drawn_picture(preview: Preview, marks: Marks, health: SensorHealth | None) -> DrawnPicture:
    """Return a sensor's picture with the fruit in it."""
    word, text = health_words(health)
    fruit = tuple(_drawn_fruit(one, marks) for one in preview.fruit if len(one.outline_px) > 2)
    return DrawnPicture(preview.station_id, preview.color, fruit, word, text, stale_words(health))


def stale_words(health: SensorHealth | None) -> str:
    """Return for how long a sensor that gives nothing has given nothing; empty for one that runs."""
    if health is None or (health.state in (Running.RUNNING, Running.STARTING) and not health.hangs):
        return ""
    if health.state is Running.ENDED:
        return QCoreApplication.translate("Health", "the last picture of the recording")
    if health.age_s is None:
        return QCoreApplication.translate("Health", "no picture yet")
    since = duration_text(health.age_s)
    return QCoreApplication.translate("Health", "no picture for {time}").format(time=since)


def _drawn_fruit(one: Pictured, marks: Marks) -> DrawnFruit:
    mark = marks.of(UNKNOWN if one.opinion is None else one.opinion.kind)
    return DrawnFruit(one.track, mark, one.outline_px, opinion_words(one.opinion), one.spread, one.trail_px)


def opinion_words(opinion: Opinion | None) -> tuple[str, ...]:
    """Return what is thought of a fruit so far: kind with probability, volume with its interval."""
    if opinion is None:
        return ()
    volume = opinion.volume_m3
    sure = "" if opinion.kind == UNKNOWN else f" {percent_text(opinion.probability)}"
    return (
        f"{kind_name(opinion.kind)}{sure}",
        measured_text(volume.value * ML_PER_M3, volume.std * ML_PER_M3, "ml"),
    )


def health_words(health: SensorHealth | None) -> tuple[str, str]:
    """Return how a sensor is, as `good`, `warn` or `bad`, and in words."""
    if health is None:
        return "warn", ""
    if health.hangs:
        return "bad", QCoreApplication.translate("Health", "does not answer")
    if health.blinded_by:
        return "warn", QCoreApplication.translate("Health", "may be blinded")
    if health.useless:
        return "bad", QCoreApplication.translate("Health", "loses pictures")
    if health.state is Running.RUNNING:
        return "good", f"{number_text(health.rate_hz, 1)}/s"
    words = {
        Running.STARTING: ("warn", QCoreApplication.translate("Health", "starting")),
        Running.SILENT: ("bad", QCoreApplication.translate("Health", "silent")),
        Running.FAILED: ("bad", QCoreApplication.translate("Health", "failed, is opened again")),
        Running.ENDED: ("warn", QCoreApplication.translate("Health", "recording is over")),
        Running.STOPPED: ("warn", QCoreApplication.translate("Health", "stopped")),
    }
    return words[health.state]


def belt_map(state: LiveState, marks: Marks) -> BeltMap:
    """Return the belt from above."""
    blind = state.blind
    away = frozenset() if blind is None else frozenset(blind.sensors)
    speed = None if state.belt_velocity_m_s is None else float(np.linalg.norm(state.belt_velocity_m_s))
    fruit = tuple(_mapped_fruit(one, marks) for one in state.tracks)
    words, lost = ("", False) if blind is None else (blind_text(blind), blind.loses_fruit)
    return BeltMap(dict(state.footprints_m), away, fruit, speed, words, lost)


def _mapped_fruit(one: TrackNow, marks: Marks) -> MappedFruit:
    mark = marks.of(UNKNOWN if one.opinion is None else one.opinion.kind)
    return MappedFruit(one.track, mark, _radius_m(one.footprint_m), one.spread, one.trail_m)


def _radius_m(footprint_m: F64) -> float:
    """Return half the length of an outline seen from above."""
    if len(footprint_m) < 2:
        return 0.02
    return float(np.max(np.ptp(footprint_m, axis=0))) / 2.0


def last_fruit(last: Sequence[tuple[CountedFruit, Finished]], marks: Marks) -> list[LastFruit]:
    """Return the last fruit counted, the newest first."""
    shown = []
    for counted, finished in last:
        fruit = counted.fruit
        picture = next((crop.data for crop in finished.crops if crop.content == "colour"), None)
        shown.append(
            LastFruit(
                counted.key, counted.number, marks.of(fruit.kind), kind_name(fruit.kind), fruit.kind_probability,
                fruit.volume_m3.value * ML_PER_M3, fruit.volume_m3.std * ML_PER_M3, picture,
            )
        )  # fmt: skip
    return shown


def kind_lines(tally: Tally, kinds: Sequence[str], marks: Marks, now_s: float) -> list[KindLine]:
    """Return a line for each kind of the model, then for whatever else was counted, `unknown` last."""
    order = [kind for kind in dict.fromkeys([*kinds, *tally.sums]) if kind != UNKNOWN] + [UNKNOWN]
    per_minute = tally.per_minute(now_s)
    return [_kind_line(kind, tally.sums.get(kind, KindSum()), marks, per_minute.get(kind, 0.0)) for kind in order]


def _kind_line(kind: str, total: KindSum, marks: Marks, per_minute: float) -> KindLine:
    mean_ml = total.mean_ml
    return KindLine(
        mark=marks.of(kind),
        name=kind_name(kind),
        count=total.count,
        volume_ml=None if mean_ml is None else mean_ml.value,
        volume_half_ml=None if mean_ml is None else HALF_95 * mean_ml.std,
        spread_ml=total.spread_ml,
        total_l=total.volume_ml / ML_PER_L,
        mass_kg=total.mass_kg,
        per_minute=round(per_minute),
    )


def bars(histogram: Histogram | None, marks: Marks) -> list[Bars]:
    """Return a histogram's bars."""
    return [] if histogram is None else [Bars(marks.of(kind), counts) for kind, counts in histogram.counts.items()]
