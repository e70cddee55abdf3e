"""A refusal: what was seen, why that is not enough, and a picture of what to put where."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtWidgets import QHBoxLayout, QVBoxLayout, QWidget

from fruitgui.gui.steps.calibrate.reasons import Told
from fruitgui.gui.steps.calibrate.sketch_view import SketchView
from fruitgui.gui.steps.calibrate.sketches import WRONG_AND_RIGHT
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.cards import Card, label
from fruitgui.gui.widgets.rig_graph import GraphLink, GraphNode, RigGraph
from fruitgui.gui.widgets.scrolled import Scrolled
from fruitgui.gui.widgets.worded import Worded

MOST_SHOWN = 4


class ReasonCard(Card):
    """One reason with its two pictures: as it is, and as it should be."""

    def __init__(self, told: Told, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(told.seen, parent)
        self.told = told
        self._title.setWordWrap(True)
        why, remedy = label(told.why, "dim"), label(told.remedy, "strong")
        for one in (why, remedy):
            one.setWordWrap(True)
        pictures = QHBoxLayout()
        pictures.setSpacing(1 * GRID)
        for sketch in WRONG_AND_RIGHT[told.code]:
            view = SketchView(theme)
            view.show_sketch(sketch, told.remedy if sketch.good else told.seen)
            pictures.addWidget(view, 1)
        self.body.addWidget(why)
        self.body.addLayout(pictures)
        self.body.addWidget(remedy)


class RefusedPanel(Worded, QWidget):
    """Reasons at the left, what links the sensors at the right."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self.graph = RigGraph(theme)
        self._links = Card()
        self._title, self._more = label("", "page"), label("", "dim")
        self._more_count = 0
        self._column = QVBoxLayout()
        self.cards: list[ReasonCard] = []
        self._lay_out()
        self._say_words()

    def show_reasons(self, told: Sequence[Told], nodes: Sequence[GraphNode], links: Sequence[GraphLink]) -> None:
        """Show why it was refused."""
        for card in self.cards:
            self._column.removeWidget(card)
            card.hide()
            card.deleteLater()
        self.cards = [ReasonCard(one, self._theme) for one in told[:MOST_SHOWN]]
        for card in self.cards:
            self._column.addWidget(card)
        self._more_count = max(len(told) - MOST_SHOWN, 0)
        self.graph.show_graph(nodes, links)
        self._say_words()

    def _lay_out(self) -> None:
        self._title.setWordWrap(True)
        inner = QWidget()
        column = QVBoxLayout(inner)
        column.setContentsMargins(0, 0, GRID, 0)
        column.setSpacing(2 * GRID)
        self._column.setSpacing(2 * GRID)
        column.addLayout(self._column)
        column.addWidget(self._more)
        column.addStretch()
        scroll = Scrolled(inner)
        self._links.body.addWidget(self.graph, 1)
        row = QHBoxLayout()
        row.setSpacing(2 * GRID)
        row.addWidget(scroll, 3)
        row.addWidget(self._links, 2)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.setSpacing(2 * GRID)
        whole.addWidget(self._title)
        whole.addLayout(row, 1)

    def _say_words(self) -> None:
        self._title.setText(self.tr("Redo: the sensors could not be placed, and nothing was changed"))
        self._links.set_title(self.tr("What links the sensors"))
        self._more.setText(self.tr("And {count} more of the same.").format(count=self._more_count))
        self._more.setVisible(self._more_count > 0)
