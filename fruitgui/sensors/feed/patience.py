"""How long a sensor has owed a frame: time in which its projector is to be dark does not count."""

from __future__ import annotations


class Patience:
    """Counts the time without a frame while frames are expected, seconds. One thread writes, any may read."""

    def __init__(self) -> None:
        # How long frames were owed before it last went dark, and since when they are owed now: replaced as one.
        self._owed: tuple[float, float | None] = (0.0, None)

    def expect(self, now_s: float) -> None:
        """Expect frames from now on."""
        owed_s, since_s = self._owed
        if since_s is None:
            self._owed = (owed_s, now_s)

    def rest(self, now_s: float) -> None:
        """Expect none from now on."""
        self._owed = (self.owed_s(now_s), None)

    def hear(self, now_s: float) -> None:
        """Note that a frame came."""
        self._owed = (0.0, now_s)

    def forget(self) -> None:
        """Expect none, and begin anew."""
        self._owed = (0.0, None)

    def owed_s(self, now_s: float) -> float:
        """Return for how long a frame is owed."""
        owed_s, since_s = self._owed
        return owed_s if since_s is None else owed_s + max(now_s - since_s, 0.0)
