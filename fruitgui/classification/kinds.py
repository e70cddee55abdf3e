"""What may be the name of a kind."""

from __future__ import annotations

from collections.abc import Sequence

from fruitgui.classification.evidence import UNKNOWN
from fruitgui.errors import InputError

MAX_KINDS = 64
MAX_LENGTH = 64


def checked_kinds(kinds: Sequence[object]) -> tuple[str, ...]:
    """Return the kinds if they can be those of a model.

    Raises:
        InputError: none or more than 64, one twice, one that is empty, too long, not printable, or `unknown`.
    """
    if not 1 <= len(kinds) <= MAX_KINDS:
        raise _bad_kinds(f"there are {len(kinds)} kinds; there must be 1 to {MAX_KINDS}")
    names: list[str] = []
    for kind in kinds:
        if not isinstance(kind, str) or not kind.strip() or len(kind) > MAX_LENGTH or not kind.isprintable():
            raise _bad_kinds(f"{str(kind)[:MAX_LENGTH]!r} is not a name of 1 to {MAX_LENGTH} printable characters")
        if kind == UNKNOWN:
            raise _bad_kinds(f"{UNKNOWN!r} is what everything else is called")
        names.append(kind)
    if len(set(names)) < len(names):
        raise _bad_kinds("one kind is named twice")
    return tuple(names)


def _bad_kinds(what: str) -> InputError:
    return InputError("bad_kinds", f"The names of the kinds cannot be used: {what}.", "Rename the kinds.")
