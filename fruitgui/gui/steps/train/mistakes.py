"""The worst mistakes as pictures, with the way back to their labels."""

from __future__ import annotations

from PySide6.QtCore import QModelIndex, Signal
from PySide6.QtWidgets import QStackedLayout, QVBoxLayout, QWidget

from fruitgui.classification.confusion import Judged
from fruitgui.gui.kind_words import kind_name
from fruitgui.gui.numbers import percent_text
from fruitgui.gui.steps.teach.fruit_model import KEY, FruitModel
from fruitgui.gui.steps.teach.grid import FruitGrid
from fruitgui.gui.steps.teach.tile import Tile
from fruitgui.gui.theme.kinds import UNKNOWN_MARK, KindMark, kind_marks
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.cards import EmptyPlace, label
from fruitgui.gui.widgets.worded import Worded
from fruitgui.records.crops import Crops
from fruitgui.records.training import Trained


class MistakesView(Worded, QWidget):
    """Held-out fruit that were got wrong, the surest mistake first.

    Attributes:
        wanted: the key of a fruit whose label is to be looked at.
        chosen_changed: another one is chosen.
    """

    wanted = Signal(int)
    chosen_changed = Signal()

    def __init__(self, crops: Crops, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._judged: dict[int, Judged] = {}
        self._marks: dict[str, KindMark] = kind_marks(())
        self.model = FruitModel(crops, self._described, self)
        self.grid = FruitGrid(self.model, self, theme)
        self.none = EmptyPlace(theme, "good")
        self._how = label("", "dim")
        self._how.setWordWrap(True)
        body = QWidget()
        column = QVBoxLayout(body)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(GRID)
        column.addWidget(self._how)
        column.addWidget(self.grid, 1)
        self._stack = QStackedLayout(self)
        self._stack.addWidget(body)
        self._stack.addWidget(self.none)
        self._body = body
        self.grid.activated.connect(self._activate)
        self.grid.chosen_changed.connect(self.chosen_changed)
        self._say_words()

    @property
    def chosen(self) -> int | None:
        """The key of the fruit that is chosen."""
        return next(iter(self.grid.chosen()), None)

    def show_trained(self, trained: Trained, marks: dict[str, KindMark]) -> None:
        """Show the mistakes of a model."""
        self._marks = marks
        worst = trained.outcome.training.worst
        self._judged = {trained.keys[one.fruit.fruit_id]: one for one in worst if one.fruit.fruit_id in trained.keys}
        self.grid.show_keys(list(self._judged))
        self._stack.setCurrentWidget(self._body if self._judged else self.none)

    def tile(self, key: int) -> Tile:
        """Return what is shown of a fruit: what it is, and what it was taken for."""
        one = self._judged[key]
        sure = percent_text(one.vote.probability)
        words = self.tr("{kind}, taken for {other} with {sure}").format(
            kind=kind_name(one.fruit.kind), other=kind_name(one.vote.kind), sure=sure
        )
        mark, other = (self._marks.get(kind, UNKNOWN_MARK) for kind in (one.fruit.kind, one.vote.kind))
        return Tile(mark, words, guessed=False, measured=False, other=other, sure=sure)

    def _say_words(self) -> None:
        self._how.setText(
            self.tr("What it was named → what it was taken for, and how surely. A wrong label is put right on the "
                    "screen “Teach”: choose a fruit and press Enter.")
        )  # fmt: skip
        self.none.show_words(
            self.tr("Not one mistake"), self.tr("Every fruit that was held out got the kind that a person gave it.")
        )

    def _described(self, key: int) -> str:
        return self.tile(key).words if key in self._judged else ""

    def _activate(self, index: QModelIndex) -> None:
        self.wanted.emit(int(index.data(KEY)))
