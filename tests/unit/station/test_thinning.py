from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from fruitgui.station.thinning import Thinned


@given(st.integers(2, 40), st.integers(0, 2000))
def test_the_choice_is_even_and_bounded(most: int, count: int) -> None:
    kept = Thinned[int](most)
    for item in range(count):
        kept.add(item)
    items = kept.items()
    assert len(items) <= most
    assert items[:1] == [0][:count]
    assert len(items) >= min(count, most // 2)
    assert len(set(np.diff(items))) <= 1
