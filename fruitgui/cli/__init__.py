"""The same jobs without a window."""

from fruitgui.cli.program import main

__all__ = ["main"]
