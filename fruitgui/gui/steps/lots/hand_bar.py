"""Where a person says what fruit are, against the machine where it erred."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from PySide6.QtCore import QEvent, QSize, Qt, Signal
from PySide6.QtGui import QAction, QIcon, QKeySequence, QShortcut
from PySide6.QtWidgets import QHBoxLayout, QInputDialog, QMenu, QPushButton, QWidget

from fruitgui.gui.kind_words import kind_name
from fruitgui.gui.steps.lots.hand import Deed
from fruitgui.gui.theme import icons
from fruitgui.gui.theme.kinds import UNKNOWN, UNKNOWN_MARK, KindMark
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.kind_mark import mark_pixmap
from fruitgui.station.kind_names import known_kind
from fruitgui.station.labels import LONGEST_KIND

MOST_KEYS = 9


class HandBar(QWidget):
    """Buttons and keys for the fruit that are chosen.

    Args:
        theme: shared.
        within: the widget in which the keys work.

    Attributes:
        said: a `Deed`, a kind, a note.
        undo_wanted: the last word is to be taken back.
    """

    said = Signal(object, str, str)
    undo_wanted = Signal()

    def __init__(self, theme: Theme, within: QWidget) -> None:
        super().__init__()
        self._theme = theme
        self._kinds: Sequence[str] = ()
        self._marks: Mapping[str, KindMark] = {}
        self._kind, self._counted, self._dialog = "", True, QInputDialog(self)
        self.name, self.leave, self.note, self.undo = QPushButton(), QPushButton(), QPushButton(), QPushButton()
        self.add = QPushButton()
        self._menu, self._missed = QMenu(self), QMenu(self)
        self._lay_out()
        self._connect(within)
        self._say_words()
        self._draw()

    def show_kinds(self, kinds: Sequence[str], marks: Mapping[str, KindMark]) -> None:
        """Offer these kinds, in this order; the first nine have keys."""
        self._kinds, self._marks = kinds, marks
        self._fill()

    def show_chosen(self, count: int, kind: str, counted: bool, can_undo: bool) -> None:
        """Follow what is chosen: how many fruit, of which kind the first is, and whether it counts."""
        self._kind, self._counted = kind, counted
        for button in (self.name, self.leave):
            button.setEnabled(count > 0)
        self.note.setEnabled(count == 1)
        self.undo.setEnabled(can_undo)
        self._say_words()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Take over another language."""
        if event.type() == QEvent.Type.LanguageChange:
            self._say_words()
            self._fill()
        super().changeEvent(event)

    def _lay_out(self) -> None:
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(GRID)
        for button in (self.name, self.leave, self.note):
            row.addWidget(button)
        row.addStretch()
        row.addWidget(self.add)
        row.addWidget(self.undo)
        self.name.setMenu(self._menu)
        self.add.setMenu(self._missed)

    def _connect(self, within: QWidget) -> None:
        self.leave.clicked.connect(self._leave)
        self.note.clicked.connect(self._ask_note)
        self.undo.clicked.connect(self.undo_wanted)
        self._menu.triggered.connect(self._chosen)
        self._missed.triggered.connect(self._add)
        self._theme.changed.connect(self._draw)
        self._dialog.setInputMode(QInputDialog.InputMode.TextInput)
        self._dialog.textValueSelected.connect(self._typed)
        context = Qt.ShortcutContext.WidgetWithChildrenShortcut
        for number in range(MOST_KEYS):
            key = QShortcut(QKeySequence(str(number + 1)), within, context=context)
            key.setProperty("number", number)
            key.activated.connect(self._pressed)
        for text, act in (
            ("0", self._name_unknown), ("Del", self._leave), ("N", self._ask_note), ("K", self.name.showMenu),
            ("Ins", self.add.showMenu),
            ("Ctrl+Z", self._undo),
        ):  # fmt: skip
            QShortcut(QKeySequence(text), within, context=context).activated.connect(act)

    def _say_words(self) -> None:
        texts = {
            self.name: (self.tr("It is …"), self.tr("Say of which kind the chosen fruit are (keys 1 to 9, or K)")),
            self.leave: (
                (self.tr("Leave out"), self.tr("Do not count the chosen fruit; they stay in the records (Delete)"))
                if self._counted
                else (self.tr("Put back"), self.tr("Count the chosen fruit after all (Delete)"))
            ),
            self.note: (self.tr("Note …"), self.tr("Write something on the chosen fruit (N)")),
            self.add: (
                self.tr("Missed one …"),
                self.tr("Add a fruit that passed and was not counted; it has no measures (Ins)"),
            ),
            self.undo: (self.tr("Undo"), self.tr("Take the last correction back (Ctrl+Z)")),
        }
        for button, (text, tip) in texts.items():
            button.setText(text)
            button.setToolTip(tip)
            button.setAccessibleName(text)

    def _draw(self) -> None:
        colour, dim = self._theme.colour("text"), self._theme.colour("line")
        for button, icon in (
            (self.name, "edit"), (self.leave, "remove" if self._counted else "add"), (self.note, "report"),
            (self.add, "add"), (self.undo, "undo"),
        ):  # fmt: skip
            button.setIcon(icons.icon(icon, colour, dim))
            button.setIconSize(QSize(20, 20))

    def _fill(self) -> None:
        for menu in (self._menu, self._missed):
            menu.clear()
            for number, kind in enumerate(self._kinds):
                key = str(number + 1) if number < MOST_KEYS and menu is self._menu else ""
                self._offer(menu, f"{key}\u2002{kind_name(kind)}", kind)
            self._offer(menu, f"{'0' if menu is self._menu else ''}\u2002{kind_name(UNKNOWN)}", UNKNOWN)
        self._menu.addSeparator()
        self._offer(self._menu, self.tr("Another kind …"), "")

    def _offer(self, menu: QMenu, text: str, kind: str) -> None:
        action = QAction(text.strip(), menu)
        action.setData(kind)
        if kind:
            action.setIcon(QIcon(mark_pixmap(self._marks.get(kind, UNKNOWN_MARK), 40)))
        menu.addAction(action)

    def _chosen(self, action: QAction) -> None:
        if action.data():
            self._name(str(action.data()))
        else:
            self._ask(self.tr("Another kind"), self.tr("What the chosen fruit are:"), Deed.NAME, LONGEST_KIND)

    def _add(self, action: QAction) -> None:
        self.said.emit(Deed.ADD, str(action.data()), "")

    def _pressed(self) -> None:
        key = self.sender()
        number = MOST_KEYS if key is None else int(key.property("number"))
        if number < len(self._kinds):
            self._name(self._kinds[number])

    def _name_unknown(self) -> None:
        self._name(UNKNOWN)

    def _name(self, kind: str) -> None:
        if self.name.isEnabled():
            self.said.emit(Deed.NAME, kind, "")

    def _leave(self) -> None:
        if self.leave.isEnabled():
            self.said.emit(Deed.LEAVE_OUT if self._counted else Deed.PUT_BACK, "", "")

    def _undo(self) -> None:
        if self.undo.isEnabled():
            self.undo_wanted.emit()

    def _ask_note(self) -> None:
        if self.note.isEnabled():
            self._ask(self.tr("Note"), self.tr("What is to be said of this fruit:"), None, 0)

    def _ask(self, title: str, text: str, deed: Deed | None, longest: int) -> None:
        self._dialog.setProperty("deed", "" if deed is None else deed.value)
        self._dialog.setProperty("longest", longest)
        self._dialog.setWindowTitle(title)
        self._dialog.setLabelText(text)
        self._dialog.setTextValue("")
        self._dialog.open()

    def _typed(self, text: str) -> None:
        text = " ".join(text.split())
        if not text:
            return
        if self._dialog.property("deed"):
            kind = known_kind(text[: int(self._dialog.property("longest"))], self._kinds)
            self.said.emit(Deed.NAME, kind, "")
        else:  # a note says again what holds, and why
            self.said.emit(Deed.NAME, self._kind, text)
