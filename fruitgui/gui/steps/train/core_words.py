"""What the core says while and after it trains, in the operator's language; what is not known is said as it is."""

from __future__ import annotations

import re
from collections.abc import Mapping

from PySide6.QtCore import QCoreApplication

from fruitgui.gui.kind_words import kind_name

translate = QCoreApplication.translate

KINDS = ("kind", "one", "other")
"""Parts of a sentence that name kinds."""


def _patterns() -> Mapping[str, str]:
    return {
        r"Judging fruit that training did not see": translate("Train", "Judging fruit that training did not see"),
        r"Training on all fruit": translate("Train", "Training on all fruit"),
        r"Finding out whether more fruit would help": translate("Train", "Finding out whether more fruit would help"),
        r"Comparing with the model in use": translate("Train", "Comparing with the model in use"),
        r"Checking volumes": translate("Train", "Checking volumes on fruit left out in turn"),
        r"(?P<kind>.+): only 1 distinct fruit, .*; show (?P<want>\d+) or more\.": translate(
            "Train", "{kind}: a single fruit cannot be judged by others; show {want} or more."
        ),
        r"(?P<kind>.+): only (?P<have>\d+) distinct fruit, .*; show (?P<want>\d+) or more\.": translate(
            "Train", "{kind}: {have} fruit teach little; show {want} or more."
        ),
        r"(?P<kind>.+): only (?P<have>\d+) views; show (?P<want>\d+) or more\.": translate(
            "Train", "{kind}: {have} views are few; show {want} or more."
        ),
        r"Uneven: (?P<most>\d+) of (?P<one>.+) but (?P<least>\d+) of (?P<other>.+); show more of those\.": translate(
            "Train", "There are {most} of {one} but only {least} of {other}; show more of those."
        ),
        r"Only one kind: .*": translate("Train", "With one kind only, it can tell that from other things, no more."),
    }


def in_words(said: str) -> str:
    """Return what the core said, in the operator's language."""
    for pattern, text in _patterns().items():
        match = re.fullmatch(pattern, said)
        if match is not None:
            kinds = {name: kind_name(value) for name, value in match.groupdict().items() if name in KINDS}
            return text.format(**{**match.groupdict(), **kinds})
    return said
