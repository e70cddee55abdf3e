"""Parts take the place of the groups they were cut from, and every fruit keeps a number of its own."""

from __future__ import annotations

import cv2
import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from fruitgui.perception.outline import Contour
from fruitgui.perception.parts import with_parts
from fruitgui.perception.segment import Groups, drawn


def square(group: int, left: int = 0, width: int = 12) -> Contour:
    start = 20 * group + left
    corners = [(start, 4), (start, 15), (start + width - 1, 15), (start + width - 1, 4)]
    return np.array(corners, dtype=np.int32)[:, None, :]


def row_of_groups(count: int) -> Groups:
    contours = tuple(square(number) for number in range(count))
    labels = drawn(contours, (20, 20 * count))
    return Groups(labels, np.zeros(labels.shape, np.uint16), contours, tuple(cv2.boundingRect(one) for one in contours))


@given(st.integers(1, 6), st.data())
def test_labels_outlines_and_origins_agree_whatever_is_split_or_dropped(count: int, data: st.DataObject) -> None:
    pieces = data.draw(st.dictionaries(st.integers(0, count - 1), st.integers(0, 3), min_size=1))
    cuts = {group: [square(group, 4 * piece, 4) for piece in range(found)] for group, found in pieces.items()}
    parts = with_parts(row_of_groups(count), cuts)
    assert sorted(parts.group.tolist()) == [group for group in range(count) for _ in range(pieces.get(group, 1))]
    assert parts.shared.tolist() == [group in cuts for group in parts.group.tolist()]
    assert parts.boxes == tuple(cv2.boundingRect(contour) for contour in parts.contours)
    assert (parts.labels == drawn(parts.contours, parts.labels.shape)).all()
