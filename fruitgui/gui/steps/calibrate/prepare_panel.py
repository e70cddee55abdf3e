"""Before calibrating: what to put on the belt, and what the sensors have in common now."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtWidgets import QHBoxLayout, QVBoxLayout, QWidget

from fruitgui.calibration.outlook import ENOUGH_COMMON, LEAST_COMMON
from fruitgui.gui.session import Session
from fruitgui.gui.steps.calibrate.prospect import Prospect
from fruitgui.gui.steps.calibrate.sketch_view import SketchView
from fruitgui.gui.steps.calibrate.sketches import PREPARE
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.cards import Card, label, set_health
from fruitgui.gui.widgets.rig_graph import RigGraph
from fruitgui.gui.widgets.show_switch import ShowSwitch
from fruitgui.gui.widgets.worded import Worded


class PreparePanel(Worded, QWidget):
    """Advice at the left, the meter at the right."""

    def __init__(self, session: Session, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.sketch, self.graph = SketchView(theme), RigGraph(theme)
        self.switch = ShowSwitch(session.source)
        self.advice, self.meter = Card(), Card()
        self._rules = [label("") for _ in range(3)]
        self.sentence, self._legend = label("", "strong"), label("", "small")
        self._lay_out()
        self._say_words()

    def show_prospect(self, prospect: Prospect) -> None:
        """Show what calibrating would have to work with."""
        self.graph.show_graph(prospect.nodes, prospect.links)
        self.sentence.setText(prospect.sentence)
        set_health(self.sentence, prospect.health)

    def _lay_out(self) -> None:
        for one in (*self._rules, self.sentence, self._legend):
            one.setWordWrap(True)
        self.advice.body.setSpacing(1 * GRID)
        self.advice.body.addWidget(self.sketch)
        self._fill(self.advice.body, self._rules)
        self.advice.body.addStretch()
        self.advice.body.addWidget(self.switch)
        self.meter.body.addWidget(self.sentence)
        self.meter.body.addWidget(self.graph, 1)
        self.meter.body.addWidget(self._legend)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(2 * GRID)
        row.addWidget(self.advice, 9)
        row.addWidget(self.meter, 10)

    def _fill(self, column: QVBoxLayout, rows: Sequence[QWidget]) -> None:
        for one in rows:
            column.addWidget(one)

    def _say_words(self) -> None:
        self.advice.set_title(self.tr("Put fruit on the belt, and stop it"))
        self.meter.set_title(self.tr("What the sensors have in common now"))
        self._legend.setText(
            self.tr(
                "Counted are the pieces that two sensors see alike and in the same arrangement: {least} are needed, "
                "{enough} are good."
            ).format(least=LEAST_COMMON, enough=ENOUGH_COMMON)
        )
        rules = (
            self.tr("1.  Ten or more pieces of different kinds and sizes, spread unevenly."),
            self.tr("2.  Most of them where the views overlap."),
            self.tr("3.  Belt and fruit at rest, hands away."),
        )
        for row, text in zip(self._rules, rules, strict=True):
            row.setText(text)
        self.sketch.show_sketch(PREPARE[0], " ".join(rules))
