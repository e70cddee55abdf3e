"""The tracker on a reduced line: every fruit once, whatever the belt and the sensors do."""

from __future__ import annotations

from collections import Counter

import pytest

from fruitgui.tracking.track import Track
from fruitgui.tracking.tracker import Tracker
from tests.unit.tracking.line import Line, opposed, pieces


def piece_of(track: Track) -> int:
    """Return the number of the piece that most of the track's sightings show."""
    return Counter(int(sighting.view.features[0]) for sighting in track.sightings).most_common(1)[0][0]


def follow(line: Line) -> list[Track]:
    tracker = Tracker(line.rig)
    finished = [track for observation in line.observations() for track in tracker.update(observation)]
    return finished + tracker.finish()


@pytest.mark.parametrize("speed", [0.1, 0.4, 0.8])
def test_counts_every_fruit_once_at_any_speed(speed: float) -> None:
    line = Line(opposed(), pieces(24), lambda t: speed * t, duration_s=3.2 / speed)
    assert sorted(piece_of(track) for track in follow(line)) == list(range(24))
