"""What can be done at each stage of measuring a sensor's depth."""

from __future__ import annotations

from PySide6.QtCore import QObject
from PySide6.QtGui import QAction

from fruitgui.gui.steps.connect.depth.course import Course, Stage


class WizardActions(QObject):
    """The actions, made once; a page offers some of them."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.take, self.keep, self.again = QAction(self), QAction(self), QAction(self)
        self.more, self.skip = QAction(self), QAction(self)
        self.higher, self.undo = QAction(self), QAction(self)
        self.remove, self.back = QAction(self), QAction(self)
        self.say_words()

    def at(self, course: Course, *, corrected: bool) -> tuple[QAction, ...]:
        """Return the main action of a stage, then the others; a correction can be taken away where there is one."""
        if course.stage is Stage.RESULT:
            done = (self.keep, self.higher, self.again) if course.fit is not None else (self.again,)
            return (*done, self.undo, self.back)
        others: tuple[QAction, ...] = (self.remove,) if corrected and course.stage is Stage.BELT else ()
        others += (self.skip,) if course.can_pass else ()
        others += (self.more,) if course.stage is Stage.BALL else ()
        others += (self.undo,) if course.before is not None else ()
        return (self.take, *others, self.back)

    def say_words(self) -> None:
        """Say what they do, in the language of now."""
        for action, text, tip, icon, key in (
            (self.take, self.tr("Take"), self.tr("Take pictures of what lies there"), "camera", "Ctrl+Return"),
            (self.keep, self.tr("Keep"), self.tr("Correct this sensor's depth so from now on"), "save",
             "Ctrl+Return"),
            (self.again, self.tr("Measure again"), self.tr("Begin again with the bare belt"), "redo", "Ctrl+N"),
            (self.more, self.tr("Another box"), self.tr("Take a box of another height as well"), "add",
             "Ctrl+Shift+B"),
            (self.higher, self.tr("Another height"), self.tr("Take the belt from one more height as well"), "add",
             "Ctrl+Shift+H"),
            (self.undo, self.tr("Undo"), self.tr("Undo the last step, and do it again"), "undo", "Ctrl+Z"),
            (self.skip, self.tr("Without it"), self.tr("Go on without it"), "right", "Ctrl+Shift+Right"),
            (self.remove, self.tr("Take correction away"),
             self.tr("Use this sensor's depth as the device gives it"), "delete", "Ctrl+Shift+Del"),
            (self.back, self.tr("Back"), self.tr("Back to the sensors; nothing is kept"), "left",
             "Ctrl+Backspace"),
        ):  # fmt: skip
            action.setText(text)
            action.setToolTip(tip)
            action.setProperty("drawing", icon)
            action.setShortcut(key)
