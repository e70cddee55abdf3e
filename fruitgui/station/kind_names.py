"""When two names of kinds are one name: people would read them as the same."""

from __future__ import annotations

from collections.abc import Iterable
from unicodedata import normalize

from fruitgui.classification.evidence import UNKNOWN


def known_kind(kind: str, known: Iterable[str]) -> str:
    """Return the first of the known kinds, `unknown` among them, that has the same name; else the kind itself.

    Names are the same that differ in nothing but case, space, `_` for a space, or how an accent is coded.
    """
    spoken = _spoken(kind)
    same = (one for one in (*known, UNKNOWN) if one == kind or _spoken(one) == spoken)
    return next(same, " ".join(kind.split()))


def _spoken(kind: str) -> str:
    return " ".join(normalize("NFKC", kind).casefold().replace("_", " ").split())
