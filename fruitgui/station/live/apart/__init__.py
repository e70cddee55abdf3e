"""The line in a process of its own: the window's process reads sensors and keeps fruit, and that is all."""

from fruitgui.station.live.apart.line_apart import LineApart

__all__ = ["LineApart"]
