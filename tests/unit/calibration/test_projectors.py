"""How long a light takes to settle, and whom it blinds, on made pictures whose truth is known."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from fruitgui.calibration.projectors.glimpse import LEAST_HOLES, LEAST_OFF_MM, Glimpse, Level, glimpse
from fruitgui.calibration.projectors.interference import Harm, interference
from fruitgui.calibration.projectors.settling import Refusal, Settled, settling_of

SHAPE = (240, 320)


def trial(
    rng: np.random.Generator, *, settles_s: float, rate_hz: float = 30.0, pictures: int = 30, noise_mm: float = 1.5,
    holes: float = 0.06, drift_mm: float = 12.0, lost: float = 0.5, base_mm: float = 1000.0,
) -> list[Glimpse]:  # fmt: skip
    """Return what a sensor gives after its projector was switched on: holes and an error of depth that fade away."""
    scene = base_mm + np.linspace(-80.0, 80.0, SHAPE[1])[None, :].repeat(SHAPE[0], axis=0)
    made = []
    start_s = rng.uniform(0.0, 1.0 / rate_hz)
    for number in range(pictures):
        since_s = start_s + number / rate_hz
        left = max(1.0 - since_s / settles_s, 0.0)
        depth = scene + drift_mm * left + rng.normal(0.0, noise_mm, SHAPE)
        depth[rng.random(SHAPE) < holes + lost * left] = 0.0
        made.append(glimpse(np.rint(depth).astype(np.uint16), since_s, number))
    return made


@settings(max_examples=25, deadline=None, phases=[Phase.explicit, Phase.generate])
@given(
    st.integers(0, 10_000), st.floats(0.0, 0.5), st.sampled_from([15.0, 30.0]), st.floats(0.3, 4.0), st.floats(0.0, 0.3)
)
def test_settling_is_told_to_a_picture_never_too_short(
    seed: int, settles_s: float, rate_hz: float, noise_mm: float, holes: float
) -> None:
    rng = np.random.default_rng(seed)
    pictures = round(1.2 * rate_hz)
    trials = [
        trial(rng, settles_s=max(settles_s, 1e-6), rate_hz=rate_hz, pictures=pictures, noise_mm=noise_mm, holes=holes)
        for _ in range(4)
    ]
    found = settling_of(trials)
    assert isinstance(found, Settled)
    # The last bit of a light that fades evenly does no harm: half a millimetre, or four thousandths of the picture.
    harmless_s = settles_s * max(LEAST_OFF_MM / 12.0, LEAST_HOLES / 0.5, 6.0 * noise_mm / np.sqrt(1200.0) / 12.0)
    assert settles_s - harmless_s - 1e-3 <= found.steady_s <= settles_s + 1.0 / rate_hz + 1e-3
    assert found.settle_s == pytest.approx(found.steady_s + 0.5 / rate_hz)
    assert found.discard_frames <= found.steady_s * rate_hz + 1e-6 < found.discard_frames + 1
    assert found.steady.holes == pytest.approx(holes, abs=0.01)
    assert found.steady.noise_mm == pytest.approx(np.hypot(noise_mm, 12**-0.5), rel=0.1)


def test_the_slowest_of_all_times_counts() -> None:
    rng = np.random.default_rng(1)
    trials = [trial(rng, settles_s=one) for one in (0.1, 0.12, 0.4, 0.1)]
    found = settling_of(trials)
    assert isinstance(found, Settled)
    assert found.steady_s > 0.37
    assert found.trials == 4


def test_a_hand_that_passes_once_is_not_the_light() -> None:
    rng = np.random.default_rng(2)
    trials = [trial(rng, settles_s=0.1) for _ in range(4)]
    trials[1][22] = replace(trials[1][22], holes=0.5)
    found = settling_of(trials)
    assert isinstance(found, Settled)
    assert found.steady_s < 0.15


def test_a_time_whose_first_pictures_were_missed_does_not_count() -> None:
    rng = np.random.default_rng(5)
    trials = [trial(rng, settles_s=0.1) for _ in range(4)]
    trials[0] = trials[0][8:]
    found = settling_of(trials)
    assert isinstance(found, Settled)
    assert found.steady_s < 0.15
    assert found.trials == 3
    assert settling_of(trials[:3]) is Refusal.TOO_FEW


def test_what_cannot_be_told_is_refused() -> None:
    rng = np.random.default_rng(3)
    good = [trial(rng, settles_s=0.1) for _ in range(4)]
    assert settling_of(good[:2]) is Refusal.TOO_FEW
    assert settling_of([one[:8] for one in good]) is Refusal.TOO_FEW
    assert settling_of([trial(rng, settles_s=2.0) for _ in range(4)]) is Refusal.UNSTEADY
    assert settling_of([*good[:3], trial(rng, settles_s=0.1, base_mm=940.0)]) is Refusal.MOVED
    assert settling_of([trial(rng, settles_s=0.1, holes=1.0) for _ in range(4)]) is Refusal.BLIND


def test_holes_and_noise_together_tell_who_is_blinded() -> None:
    rng = np.random.default_rng(4)
    steady = Level.of(trial(rng, settles_s=1e-6))
    for more, noise_mm, harm in (
        (0.0, 1.5, Harm.NONE), (0.02, 1.5, Harm.SOME), (0.0, 2.2, Harm.SOME),
        (0.15, 1.5, Harm.MUCH), (0.0, 4.0, Harm.MUCH),
    ):  # fmt: skip
        found = interference(steady, trial(rng, settles_s=1e-6, holes=0.06 + more, noise_mm=noise_mm, pictures=20))
        assert found is not None
        assert found.harm is harm, (more, noise_mm)
        assert found.holes_together - found.holes_alone == pytest.approx(more, abs=0.004)
    assert interference(steady, trial(rng, settles_s=1e-6, pictures=3)) is None


def test_edges_that_flicker_are_no_noise_of_another_light() -> None:
    rng = np.random.default_rng(6)
    steady = Level.of(trial(rng, settles_s=1e-6, pictures=20))
    together = []
    for one in trial(rng, settles_s=1e-6, pictures=10):
        depth_mm = one.depth_mm.copy()
        edge = depth_mm[0]
        edge[rng.random(edge.size) < 0.08] += 400.0
        together.append(replace(one, depth_mm=depth_mm))
    found = interference(steady, together)
    assert found is not None
    assert found.harm is Harm.NONE
