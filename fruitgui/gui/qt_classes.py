"""Has Qt's classes made before a second thread may ask for one.

PySide makes a class, its enumerations with it, when it is first asked for, and a part of that is Python: a thread that
imports a screen's module can be in the middle of one while the window's thread paints, and finds it half made. The
process then ends with a segmentation fault.
"""

from __future__ import annotations

from types import ModuleType

from PySide6 import QtCore, QtGui, QtWidgets

MODULES: tuple[ModuleType, ...] = (QtCore, QtGui, QtWidgets)
"""Those from which screens take their classes."""


def make_classes() -> int:
    """Make every class of the modules that the window uses; return how many there are.

    On the window's thread, before any other that may import a screen is started.
    """
    return sum(isinstance(getattr(module, name, None), type) for module in MODULES for name in dir(module))
