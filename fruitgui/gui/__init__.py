"""The operator's window: everything that imports Qt, and nothing that computes.

The store and the line are loaded before Qt: of every module that is loaded after it, PySide reads the source, to see
whether it names PySide, and keeps it. That were 11 MB of text in 30 MB of memory, and a sixth of a second.
"""

import fruitgui.records.store
import fruitgui.station.live  # noqa: F401
