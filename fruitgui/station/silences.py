"""Sensors that fell silent while others went on: half of what they should have seen nobody saw."""

from __future__ import annotations

from dataclasses import dataclass, field

LEAST_S = 2.0
"""Frames may come so late: a shorter gap may be no silence."""

USUAL_GAPS = 5.0
"""A sensor is silent after so many times what it usually takes between two frames."""

MOST_TOLD = 3


@dataclass(slots=True)
class _Heard:
    """One sensor: when it was last heard, the gap that is usual, and its silences so far (from, until)."""

    last_s: float
    usual_s: float = 0.0
    silent_s: list[tuple[float, float]] = field(default_factory=list)
    count: int = 0

    def take(self, time_s: float) -> None:
        gap_s = time_s - self.last_s
        if not self.usual_s:  # nothing is usual yet: this gap says what is
            self.usual_s = gap_s
        elif not self.note(time_s):
            self.usual_s = 0.9 * self.usual_s + 0.1 * gap_s
        self.last_s = time_s

    def note(self, time_s: float) -> bool:
        """Write the time since it was last heard down, if that is a silence; tell whether it is."""
        silent = time_s - self.last_s > max(LEAST_S, USUAL_GAPS * self.usual_s)
        if silent:
            self.count += 1
            if len(self.silent_s) < MOST_TOLD:
                self.silent_s.append((self.last_s, time_s))
        return silent


class Silences:
    """Listens to the capture times of all sensors, in order of the reference clock."""

    def __init__(self) -> None:
        self._sensors: dict[str, _Heard] = {}
        self._began_s: float | None = None
        self._ended_s = 0.0

    def hear(self, sensor: str, time_s: float) -> None:
        """Take a capture of a sensor. One that begins late was silent since the first capture of any."""
        self._began_s = time_s if self._began_s is None else self._began_s
        self._ended_s = max(self._ended_s, time_s)
        if sensor in self._sensors:
            self._sensors[sensor].take(time_s)
            return
        heard = self._sensors[sensor] = _Heard(self._began_s)
        heard.note(time_s)
        heard.last_s = time_s

    def warnings(self) -> list[str]:
        """Return what to say of each sensor that was silent, the end of the recording included."""
        lines = []
        for sensor, heard in self._sensors.items():
            until_end = _Heard(heard.last_s, heard.usual_s, list(heard.silent_s), heard.count)
            until_end.note(self._ended_s)
            spells = ", ".join(f"{begin:.1f} to {end:.1f} s" for begin, end in until_end.silent_s)
            more = f" and {until_end.count - MOST_TOLD} times more" if until_end.count > MOST_TOLD else ""
            if spells:
                lines.append(f"Sensor {sensor} gave no frames from {spells}{more}; what it alone sees was not counted.")
        return lines
