"""Why measurements do not do, in words: each says what is wrong and what to do."""

from __future__ import annotations

import numpy as np

from fruitgui.calibration.depth.estimate import BOW_STD_M, PRIOR_STD, Solution
from fruitgui.calibration.depth.measured import LEAST_RAISED_M, DepthReason, Measurements

FLAT_M = 3.0 * BOW_STD_M
DISAGREES = 4.0
IMPLAUSIBLE = 3.5


def disagreements(solution: Solution) -> list[DepthReason]:
    """Return the reason where a typed length contradicts all others; none where they agree."""
    worst = max(solution.typed, key=lambda one: abs(one[2]), default=("", 0, 0.0))
    if abs(worst[2]) < DISAGREES:
        return []
    what = {
        "distance": "The typed distance",
        "height": "A typed height",
        "raised": "The typed raise",
        "ball": "The typed diameter",
    }[worst[0]]
    return [
        DepthReason(
            "typed_disagrees",
            f"{what} does not go with the other measurements ({abs(worst[2]):.0f} standard deviations).",
            "Measure once more what was typed; see that the ball lies on the belt itself and the board is not tilted.",
            worst[0],
        )
    ]


def shape(solution: Solution) -> list[DepthReason]:
    """Return the reason where something is not as flat as it was taken to be."""
    if max(solution.bows_m) < FLAT_M:
        return []
    return [
        DepthReason(
            "not_flat",
            f"Belt or board is bowed by {max(solution.bows_m) * 1e3:.0f} mm.",
            "Use a stiff board, or a place where the belt lies on its table.",
        )
    ]


def undecided(measured: Measurements, free: tuple[bool, ...]) -> list[DepthReason]:
    """Return the reason where what was measured leaves scale and offset as unknown as they were."""
    if not measured.boards and not measured.balls and not measured.raised:
        return [
            DepthReason(
                "too_few_heights",
                "There is only one height: scale and offset cannot be told apart.",
                "Put a box or a ball of known size on the belt, or raise the sensor by a known length.",
            )
        ]
    if free[0] or free[1]:
        return []
    return [
        DepthReason(
            "nothing_decided",
            "The heights are too small to say more of this sensor than is known of its make.",
            "Use a higher box (15 cm or more), and measure the distance to the belt.",
        )
    ]


def implausible(solution: Solution) -> list[DepthReason]:
    """Return the reason where a device would err as none does."""
    off = np.abs(solution.terms - np.array([1.0, 0.0, 0.0, 0.0])) / np.array(PRIOR_STD)
    if off.max() < IMPLAUSIBLE:
        return []
    return [
        DepthReason(
            "implausible",
            f"This sensor's depth would be off by {abs(solution.terms[0] - 1) * 100:.0f} % and "
            f"{abs(solution.terms[1]) * 1e3:.0f} mm; no working sensor errs so much.",
            "Check what was typed, and its unit: millimetres.",
        )
    ]


NO_BELT = DepthReason("belt_not_seen", "No belt is in view.", "Let the sensor look at the bare belt from 0.5 to 2 m.")


def no_board(height_m: float) -> DepthReason:
    """Return the reason where a board is not found."""
    return DepthReason(
        "board_not_seen",
        f"No flat board {abs(height_m) * 1e3:.0f} mm above the belt is in view.",
        "Lay a flat, dull board or carton of at least 15 × 15 cm level amid the picture.",
    )


def no_ball(diameter_m: float) -> DepthReason:
    """Return the reason where a ball is not found."""
    return DepthReason(
        "ball_not_seen",
        f"No ball of {diameter_m * 1e3:.0f} mm lies on the belt.",
        "Put one dull ball on the bare belt amid the picture, and type its diameter.",
    )


def height_differs(read_m: float, typed_m: float) -> DepthReason:
    """Return the reason where a board is not as high as was typed."""
    return DepthReason(
        "height_differs",
        f"The board is typed {typed_m * 1e3:.0f} mm high, but the sensor sees about {read_m * 1e3:.0f} mm.",
        "Type the height of the board's upper side over the belt, in millimetres.",
    )


NO_BELT_FROM_HIGHER = DepthReason(
    "raised_belt_not_seen",
    "No belt is in view from where the sensor was raised to.",
    "Clear the belt, and raise the sensor straight up, so that it still looks at the belt.",
)


def raised_too_little(typed_m: float) -> DepthReason:
    """Return the reason where a second height is not different enough."""
    return DepthReason(
        "raised_too_little",
        f"The sensor was raised by {typed_m * 1e3:.0f} mm: the two heights are too near to each other.",
        f"Raise it by {LEAST_RAISED_M * 1e3:.0f} mm or more.",
    )


def raised_differs(read_m: float, typed_m: float) -> DepthReason:
    """Return the reason where a sensor was raised by another length than was typed."""
    return DepthReason(
        "raised_differs",
        f"It is typed that the sensor was raised by {typed_m * 1e3:.0f} mm, but the belt is seen "
        f"{read_m * 1e3:.0f} mm farther away.",
        "Measure from the glass to the belt before and after, and type the difference, in millimetres.",
    )
