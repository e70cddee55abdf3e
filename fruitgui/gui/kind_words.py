"""Kinds as people read them, with their marks, the same on every screen."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from PySide6.QtCore import QCoreApplication

from fruitgui.gui.theme.kinds import UNKNOWN


def kind_name(kind: str) -> str:
    """Return a kind's name as people read it; a person's own words are left as they are."""
    if kind == UNKNOWN:
        return QCoreApplication.translate("Kinds", "Unknown")
    return (kind[:1].upper() + kind[1:]).replace("_", " ")


def kinds_in_order(known: Sequence[str], more: Iterable[str]) -> tuple[str, ...]:
    """Return the kinds that are known in their order, then others by the alphabet; `unknown` is none of them."""
    order = dict.fromkeys([*known, *sorted(set(more) - set(known))])
    return tuple(kind for kind in order if kind != UNKNOWN)
