"""The device's clock: ticks of 60 MHz in 32 bits, counted on."""

from __future__ import annotations

TICKS_PER_S = 60_000_000
FRAME_TICKS = 2_000_000
"""From one picture to the next."""

_WRAP = 1 << 32


class TickCounter:
    """Counts the ticks on where 32 bits begin again, every 71.6 s; how often they did is known by the host's clock."""

    def __init__(self) -> None:
        self._last: tuple[int, float] | None = None

    def count(self, raw: int, arrived_s: float) -> int:
        """Return ticks since the counter began anew, never folded back.

        A stamp somewhat before the last one counts back: the device's pictures of one moment differ by some ms.

        Args:
            raw: the stamp, 32 bits.
            arrived_s: when it came, by the host's monotonic clock.
        """
        if self._last is None:
            ticks = raw
        else:
            last, last_s = self._last
            step = (raw - last) % _WRAP
            expected = (arrived_s - last_s) * TICKS_PER_S
            ticks = last + step + round((expected - step) / _WRAP) * _WRAP
        self._last = (ticks, arrived_s)
        return ticks
