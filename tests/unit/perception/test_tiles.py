"""Boxes of a picture laid side by side lose nothing and do not touch."""

from __future__ import annotations

import cv2
import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from fruitgui.perception.tiles import Box, edge_distance, laid_out

SHAPE = (90, 120)


@st.composite
def boxes(draw: st.DrawFn) -> list[Box]:
    found = []
    for _ in range(draw(st.integers(1, 12))):
        left, top = draw(st.integers(0, SHAPE[1] - 1)), draw(st.integers(0, SHAPE[0] - 1))
        width, height = draw(st.integers(1, SHAPE[1] - left)), draw(st.integers(1, SHAPE[0] - top))
        found.append((left, top, width, height))
    return found


@given(boxes(), st.integers(1, 5))
def test_every_box_is_in_the_mosaic_once_with_a_gap_round_it(found: list[Box], gap: int) -> None:
    tiles = laid_out(found, SHAPE, gap)
    used = np.zeros(tiles.shape, int)
    picture = np.arange(SHAPE[0] * SHAPE[1]).reshape(SHAPE)
    mosaic = tiles.cut(picture)
    for (left, top, width, height), source, place in zip(found, tiles.sources, tiles.places, strict=True):
        assert (mosaic[place] == picture[source]).all()
        assert source[0].start <= top
        assert source[0].stop >= top + height
        assert source[1].start <= left
        assert source[1].stop >= left + width
        used[place[0].start - gap : place[0].stop, place[1].start - gap : place[1].stop] += 1
        assert (np.array(used[place].shape) == np.array(mosaic[place].shape)).all()
        assert place[0].stop + gap <= tiles.shape[0]
        assert place[1].stop + gap <= tiles.shape[1]
    assert used.max() == 1


@given(boxes(), st.sampled_from([(1, 1), (2, 1), (2, 2), (3, 2)]))
def test_every_so_manieth_pixel_of_the_mosaic_is_one_of_the_picture(found: list[Box], steps: tuple[int, int]) -> None:
    tiles = laid_out(found, SHAPE, 5, steps)
    rows, columns = np.indices(SHAPE)
    on_grid = (rows % steps[0] == 0) & (columns % steps[1] == 0)
    mosaic = tiles.cut(on_grid)
    in_mosaic = np.zeros(tiles.shape, bool)
    in_mosaic[:: steps[0], :: steps[1]] = True
    for (down, across), source, shift in zip(tiles.places, tiles.sources, tiles.shifts, strict=True):
        assert (mosaic[down, across] == in_mosaic[down, across]).all()
        assert (across.start - source[1].start, down.start - source[0].start) == tuple(shift)


def test_distances_are_those_of_the_picture_also_at_its_border() -> None:
    picture = np.zeros(SHAPE, np.uint8)
    cv2.circle(picture, (40, 40), 15, 1, -1)
    cv2.circle(picture, (0, 60), 12, 2, -1)
    cv2.circle(picture, (75, 30), 9, 3, -1)
    rounds = [cv2.boundingRect((picture == number).astype(np.uint8)) for number in (1, 2, 3)]
    tiles = laid_out(rounds, SHAPE)
    found = edge_distance(tiles, cv2.compare(tiles.owned(picture), 0, cv2.CMP_GT))
    expected = cv2.distanceTransform(cv2.compare(picture, 0, cv2.CMP_GT), cv2.DIST_L2, 3)
    for source, place in zip(tiles.sources, tiles.places, strict=True):
        assert np.abs(found[place] - expected[source]).max() < 1e-3
    assert tiles.at_border == (1,)


def test_a_neighbour_in_a_box_is_not_its_own() -> None:
    picture = np.zeros(SHAPE, np.uint8)
    cv2.circle(picture, (40, 40), 15, 1, -1)
    cv2.circle(picture, (58, 58), 9, 2, -1)
    tiles = laid_out([cv2.boundingRect((picture == number).astype(np.uint8)) for number in (1, 2)], SHAPE)
    owned = tiles.owned(picture)
    for number, place in enumerate(tiles.places):
        assert set(np.unique(owned[place])) == {0, number + 1}
        assert (owned == number + 1).sum() == (picture == number + 1).sum()
