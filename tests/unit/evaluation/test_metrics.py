from __future__ import annotations

import numpy as np

from fruitgui.evaluation.metrics import mean, share


def test_a_mean_lies_in_its_interval_which_shrinks_with_more_fruit() -> None:
    rng = np.random.default_rng(1)
    few, many = mean(rng.normal(5.0, 1.0, 10)), mean(rng.normal(5.0, 1.0, 1000))
    for metric in (few, many):
        assert metric.low is not None
        assert metric.high is not None
        assert metric.low <= metric.value <= metric.high  # type: ignore[operator]
    assert many.high - many.low < few.high - few.low  # type: ignore[operator]


def test_the_interval_of_a_mean_holds_the_truth_as_often_as_it_says() -> None:
    rng = np.random.default_rng(2)
    held = 0
    for _ in range(200):
        metric = mean(rng.normal(0.0, 1.0, 40))
        held += metric.low <= 0.0 <= metric.high  # type: ignore[operator]
    assert 0.90 <= held / 200 <= 0.99


def test_forty_trials_say_as_little_as_the_source_hid() -> None:
    metric = share(38, 40)
    assert (round(metric.low or 0, 2), round(metric.high or 0, 2)) == (0.83, 0.99)


def test_nothing_counted_is_no_figure() -> None:
    assert share(0, 0).value is None
    assert mean([]).to_dict() == {"value": None, "low": None, "high": None, "n": 0}
