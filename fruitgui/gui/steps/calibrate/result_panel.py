"""After calibrating: how good it is in words and figures, the graph of the sensors, and the fused cloud."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QGridLayout, QHBoxLayout, QLabel, QVBoxLayout, QWidget

from fruitgui.gui.steps.calibrate.cloud_view import CloudView
from fruitgui.gui.steps.calibrate.verdict import Verdict
from fruitgui.gui.theme import icons
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.cards import Card, EmptyPlace, label, set_health
from fruitgui.gui.widgets.rig_graph import GraphLink, GraphNode, RigGraph
from fruitgui.gui.widgets.worded import Worded
from fruitgui.station.fused_cloud import SensorCloud

LEFT_WIDTH = 368
ICON_PX = 32


class ResultPanel(Worded, QWidget):
    """Verdict and graph at the left, cloud at the right."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._verdict: Verdict | None = None
        self.word, self.sentence = label("", "page"), label("")
        self.graph, self.cloud = RigGraph(theme), CloudView(theme)
        self._icon, self._warnings = QLabel(), label("", "small")
        self._figures = QGridLayout()
        self._links = Card()
        self._nothing = EmptyPlace(theme, "layers")
        self._lay_out()
        self._say_words()
        theme.changed.connect(self._draw_icon)

    def show_verdict(
        self, verdict: Verdict, nodes: Sequence[GraphNode], links: Sequence[GraphLink], warnings: Sequence[str]
    ) -> None:
        """Show how good it is."""
        self._verdict = verdict
        self.word.setText(verdict.word)
        set_health(self.word, verdict.health)
        self.sentence.setText(verdict.sentence)
        self._fill_figures(verdict)
        self._warnings.setText("\n".join(warnings))
        self._warnings.setVisible(bool(warnings))
        self.graph.show_graph(nodes, links)
        self._draw_icon()

    def show_clouds(self, clouds: Sequence[SensorCloud], *, compared: bool) -> None:
        """Show the fused cloud; without one, say how it comes here."""
        self.cloud.setVisible(bool(clouds))
        self._nothing.setVisible(not clouds)
        if clouds:
            self.cloud.show_clouds(clouds, compared=compared)

    def _lay_out(self) -> None:
        for one in (self.sentence, self._warnings):
            one.setWordWrap(True)
        verdict, right = Card(), Card()
        head = QHBoxLayout()
        head.setSpacing(1 * GRID)
        self._icon.setFixedSize(QSize(ICON_PX, ICON_PX))
        head.addWidget(self._icon)
        head.addWidget(self.word, 1)
        self._figures.setHorizontalSpacing(2 * GRID)
        self._figures.setVerticalSpacing(2)
        self._figures.setColumnStretch(0, 1)
        verdict.body.addLayout(head)
        verdict.body.addWidget(self.sentence)
        verdict.body.addLayout(self._figures)
        verdict.body.addWidget(self._warnings)
        self._links.body.addWidget(self.graph, 1)
        right.body.addWidget(self.cloud, 1)
        right.body.addWidget(self._nothing, 1)
        left = QWidget()
        left.setFixedWidth(LEFT_WIDTH)
        column = QVBoxLayout(left)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(2 * GRID)
        column.addWidget(verdict)
        column.addWidget(self._links, 1)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(2 * GRID)
        row.addWidget(left)
        row.addWidget(right, 1)

    def _fill_figures(self, verdict: Verdict) -> None:
        for row in range(max(len(verdict.figures), self._figures.rowCount())):
            texts = verdict.figures[row] if row < len(verdict.figures) else ("", "")
            for column, text in enumerate(texts):
                shown = self._figure(row, column)
                shown.setText(text)
                shown.setVisible(bool(text))

    def _figure(self, row: int, column: int) -> QLabel:
        """Return the label at a place, which is made once: each that is added lays the whole window out anew."""
        item = self._figures.itemAtPosition(row, column)
        widget = None if item is None else item.widget()
        if isinstance(widget, QLabel):
            return widget
        made = label("", "" if column else "dim")
        self._figures.addWidget(made, row, column, *((Qt.AlignmentFlag.AlignRight,) if column else ()))
        return made

    def _draw_icon(self) -> None:
        if self._verdict is not None:
            name, colour = self._verdict.health, self._theme.colour(self._verdict.health)
            self._icon.setPixmap(icons.pixmap(name, colour, ICON_PX, self.devicePixelRatioF()))

    def _say_words(self) -> None:
        self._links.set_title(self.tr("What links the sensors, and how far that is off"))
        self._nothing.show_words(
            self.tr("What all sensors see, laid together"),
            self.tr("It appears here as soon as the sensors run."),
        )
