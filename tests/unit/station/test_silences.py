from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import pytest

from fruitgui.station.silences import Silences


def told(**heard_s: Iterable[float]) -> list[str]:
    silences = Silences()
    captures = sorted((float(time_s), sensor) for sensor, times in heard_s.items() for time_s in times)
    for time_s, sensor in captures:
        silences.hear(sensor, time_s)
    return silences.warnings()


ALWAYS = np.arange(0, 20, 0.1)


@pytest.mark.parametrize(
    ("times", "said"),
    [
        (ALWAYS[ALWAYS < 8], "8.0 to 19.9"),
        (ALWAYS[(ALWAYS < 8) | (ALWAYS > 12)], "8.0 to 12.1"),
        (ALWAYS[ALWAYS > 5], "0.0 to 5.1"),
    ],
    ids=["to the end", "midway", "from the beginning"],
)
def test_a_silence_is_told_with_its_times(times: np.ndarray, said: str) -> None:
    (line,) = told(k1=ALWAYS, k2=times)
    assert "k2" in line
    assert float(said.split(" to ")[0]) == pytest.approx(float(line.split("from ")[1].split(" to ")[0]), abs=0.11)
    assert said.split(" to ")[1] in line


def test_steady_slow_and_shortly_late_sensors_are_not_silent() -> None:
    assert told(k1=ALWAYS, k2=ALWAYS + 0.05, k3=np.arange(0, 20, 1.5)) == []
    assert told(k1=np.arange(0, 60, 3.0)) == []


def test_many_silences_are_counted_not_listed() -> None:
    gaps = [time_s for time_s in np.arange(0, 60, 0.1) if int(time_s) % 6 < 3]
    (line,) = told(k1=np.arange(0, 60, 0.1), k2=gaps)
    assert "times more" in line
