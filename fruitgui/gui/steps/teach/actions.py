"""What can be done on the teaching screen."""

from __future__ import annotations

from PySide6.QtCore import QObject
from PySide6.QtGui import QAction, QKeySequence


class TeachActions(QObject):
    """The actions, made once; the page offers some of them, the row of shelves has the others.

    Attributes:
        watch, open, stop: let fruit come in. suggest: asks the model so far.
        tools: undo and redo, and what is done with fruit and labels.
    """

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.watch, self.open, self.stop = self._action("eye"), self._action("folder"), self._action("stop")
        self.suggest = self._action("search")
        self.undo, self.redo, self.clear = self._action("undo"), self._action("redo"), self._action("close")
        self.remove, self.see_depth = self._action("delete"), self._action("layers")
        self.take_labels, self.give_labels = self._action("import"), self._action("export")
        self.weigh = self._action("scale")
        self.see_depth.setCheckable(True)
        self.tools = (self.undo, self.redo, self.see_depth, self.clear, self.remove, self.weigh, self.take_labels,
                      self.give_labels)  # fmt: skip
        self.say_words()

    def _action(self, icon: str) -> QAction:
        action = QAction(self)
        action.setProperty("drawing", icon)
        return action

    def say_words(self) -> None:
        """Say what they do, in the language of now."""
        for action, text, tip, key in (
            (self.watch, self.tr("Watch the line"), self.tr("Let fruit pass; nothing is counted"), "Ctrl+L"),
            (self.open, self.tr("Open a recording"), self.tr("Let the fruit of a recording come in"), "Ctrl+O"),
            (self.stop, self.tr("Enough"), self.tr("Stop watching; the fruit that came in stay"), "Ctrl+Return"),
            (self.suggest, self.tr("Suggest"), self.tr("Learn from what is named so far: suggest kinds, put first what "
             "would teach most, find likely mistakes"), "Ctrl+F"),
            (self.undo, self.tr("Undo"), "", "Ctrl+Z"),
            (self.redo, self.tr("Do again"), "", "Ctrl+Y"),
            (self.see_depth, self.tr("Show depth"), "", "D"),
            (self.clear, self.tr("Let it wait: no kind"), "", "Backspace"),
            (self.remove, self.tr("Remove for good"), "", "Del"),
            (self.weigh, self.tr("Density of each kind"), "", "Ctrl+D"),
            (self.take_labels, self.tr("Read a labels file"), "", "Ctrl+Shift+O"),
            (self.give_labels, self.tr("Write a labels file"), "", "Ctrl+Shift+S"),
        ):  # fmt: skip
            action.setText(text)
            action.setToolTip(tip or text)
            action.setShortcut(QKeySequence(key))
