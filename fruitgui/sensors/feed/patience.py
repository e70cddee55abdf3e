"""How long a sensor has owed a frame: time in which its projector is to be dark does not count."""

from __future__ import annotations

from dataclasses import dataclass, replace


@dataclass(frozen=True, slots=True)
class _Owed:
    """What is owed; replaced as one, as others read it.

    Attributes:
        before_s: how long frames were owed before it last went dark.
        since_s: since when they are owed now; None where none are.
        useless_s: how long frames were owed until the last one came, since one was of use.
    """

    before_s: float = 0.0
    since_s: float | None = None
    useless_s: float = 0.0


class Patience:
    """Counts the time without a frame while frames are expected, seconds. One thread writes, any may read."""

    def __init__(self) -> None:
        self._owed = _Owed()

    def expect(self, now_s: float) -> None:
        """Expect frames from now on."""
        if self._owed.since_s is None:
            self._owed = replace(self._owed, since_s=now_s)

    def rest(self, now_s: float) -> None:
        """Expect none from now on."""
        self._owed = replace(self._owed, before_s=self.owed_s(now_s), since_s=None)

    def hear(self, now_s: float, *, of_use: bool = True) -> None:
        """Note that a frame came; one that is of no use is still owed, as one of use."""
        self._owed = _Owed(since_s=now_s, useless_s=0.0 if of_use else self.useless_s(now_s))

    def forget(self) -> None:
        """Expect none, and begin anew."""
        self._owed = _Owed()

    def owed_s(self, now_s: float) -> float:
        """Return for how long a frame is owed."""
        return _owed_s(self._owed, now_s)

    def useless_s(self, now_s: float) -> float:
        """Return for how long a frame that is of use is owed."""
        owed = self._owed
        return owed.useless_s + _owed_s(owed, now_s)


def _owed_s(owed: _Owed, now_s: float) -> float:
    return owed.before_s if owed.since_s is None else owed.before_s + max(now_s - owed.since_s, 0.0)
