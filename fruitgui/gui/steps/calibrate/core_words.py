"""What the core says while it calibrates, in the operator's language; what is not known here is said as it is."""

from __future__ import annotations

import re
from collections.abc import Mapping

from PySide6.QtCore import QCoreApplication

translate = QCoreApplication.translate


def _patterns() -> Mapping[str, str]:
    return {
        r"Collected \d+ of \d+ frames": translate("Calibrate", "Capturing the still scene: keep hands away"),
        r"Finding the belt of (?P<sensor>\w+)": translate("Calibrate", "Finding the belt of {sensor}"),
        r"Matching (?P<one>\w+) to (?P<other>\w+)": translate("Calibrate", "Matching {one} to {other}"),
        r"Placing the sensors": translate("Calibrate", "Placing the sensors"),
        r"Drawing": translate("Calibrate", "Drawing what the sensors see"),
        r"(?P<sensor>\w+): two planes in view could be the belt;.*": translate(
            "Calibrate", "{sensor} sees two surfaces that could be the belt. Check its grid on the screen “Belt”."
        ),
        r"Distances seen by (?P<one>\w+) are (?P<share>\S+) % longer than by (?P<other>\w+):.*": translate(
            "Calibrate",
            "{one} sees distances {share} % longer than {other}: the depth of one of them is off. Correct it on the "
            "screen “Connect”.",
        ),
        r"(?P<sensor>\w+) is placed to (?P<place>\S+) mm, (?P<angle>\S+)° only;.*": translate(
            "Calibrate",
            "{sensor} is placed to {place} mm and {angle}° only; more fruit in the common view would make it better.",
        ),
        r"The registration of (?P<one>\w+) to (?P<other>\w+) contradicts the others and was left out\.": translate(
            "Calibrate", "What {one} and {other} have in common contradicts the other pairs and was left out."
        ),
    }


_COMPILED = tuple(re.compile(pattern) for pattern in _patterns())
"""Compiled when the screen is made: at the moment when something is first said, the window has enough to do."""


def in_words(said: str) -> str:
    """Return what the core said, in the operator's language."""
    for pattern, text in zip(_COMPILED, _patterns().values(), strict=True):
        match = pattern.fullmatch(said)
        if match is not None:
            return text.format(**match.groupdict())
    return said
