"""When one view may be taken for two tracks."""

from __future__ import annotations

import numpy as np

from fruitgui.tracking.second_look import SHOWN_APART, _known_apart
from fruitgui.tracking.trail import Trail


def trails() -> list[Trail]:
    return [Trail(number, 0.0, np.zeros(5), 0.07) for number in (1, 2, 3)]


def test_two_halves_of_one_fruit_cut_at_the_edge_are_not_a_group() -> None:
    # Each was seen often, but no frame ever showed both: taking the later view for both would starve both.
    pair = trails()
    pair[0].clear = pair[1].clear = 10
    pair[0].company_of(2).one = 10
    assert _known_apart([0, 1], pair) == []


def test_tracks_that_frames_showed_side_by_side_are_a_group() -> None:
    three = trails()
    three[1].company_of(1).both = SHOWN_APART
    assert _known_apart([0, 1, 2], three) == [0, 1]
