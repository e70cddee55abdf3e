"""The density of each kind: what reference fruit taught, and what a person types instead."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from PySide6.QtCore import QLocale, QRegularExpression, Qt
from PySide6.QtGui import QRegularExpressionValidator
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QFrame,
    QGridLayout,
    QLineEdit,
    QPushButton,
    QScrollArea,
    QVBoxLayout,
    QWidget,
)

from fruitgui.gui.kind_words import kind_name
from fruitgui.gui.numbers import number_text
from fruitgui.gui.steps.teach.desk import KindLine
from fruitgui.gui.theme.kinds import KindMark
from fruitgui.gui.theme.tokens import GRID, TOUCH
from fruitgui.gui.widgets.cards import label, set_health
from fruitgui.gui.widgets.kind_mark import KindMarkView
from fruitgui.gui.widgets.reach import reach
from fruitgui.station.kinds_file import HEAVIEST_G_ML, LIGHTEST_G_ML

MARK_PX = 28
DIGITS = 3
ROWS = 6
"""That are seen at once, in a window of any size."""


def read_density(text: str) -> float | None:
    """Return a typed density, g/ml; None where it is none that a fruit can have. A point and a comma are the same."""
    value, good = QLocale.c().toDouble(text.strip().replace(",", "."))
    return value if good and LIGHTEST_G_ML <= value <= HEAVIEST_G_ML else None


class DensitiesDialog(QDialog):
    """A row for each kind; `typed` is what the person left it with.

    Args:
        lines: the kinds, with the densities that their reference fruit taught.
        marks: of the kinds.
        densities_g_ml: as they were typed before.
    """

    def __init__(
        self,
        lines: Sequence[KindLine],
        marks: Mapping[str, KindMark],
        densities_g_ml: Mapping[str, float],
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self.fields = {line.kind: self._field(line.kind, densities_g_ml.get(line.kind)) for line in lines}
        self._wrong = label("", "small")
        self._wrong.setWordWrap(True)
        set_health(self._wrong, "bad")
        self._buttons = QDialogButtonBox()
        self.save = QPushButton(self.tr("Save"))
        self.save.setProperty("role", "main")
        self._buttons.addButton(self.save, QDialogButtonBox.ButtonRole.AcceptRole)
        self._buttons.addButton(QPushButton(self.tr("Cancel")), QDialogButtonBox.ButtonRole.RejectRole)
        self._buttons.accepted.connect(self.accept)
        self._buttons.rejected.connect(self.reject)
        self._lay_out(lines, marks)
        self.setWindowTitle(self.tr("Density of each kind"))
        self.setMinimumWidth(560)
        self._check()

    @property
    def typed(self) -> dict[str, float | None]:
        """What stands in each kind's field, g/ml; None where there is nothing."""
        return {kind: read_density(field.text()) for kind, field in self.fields.items()}

    def _field(self, kind: str, density_g_ml: float | None) -> QLineEdit:
        field = QLineEdit("" if density_g_ml is None else number_text(density_g_ml, DIGITS))
        field.setMinimumHeight(TOUCH)
        field.setFixedWidth(120)
        field.setAlignment(Qt.AlignmentFlag.AlignRight)
        field.setPlaceholderText("–")
        field.setAccessibleName(self.tr("Density of {kind}, g/ml").format(kind=kind_name(kind)))
        field.setValidator(QRegularExpressionValidator(QRegularExpression(r"\d?([.,]\d{0,3})?"), field))
        field.textChanged.connect(self._check)
        return field

    def _lay_out(self, lines: Sequence[KindLine], marks: Mapping[str, KindMark]) -> None:
        inside = QWidget()
        inside.setProperty("role", "scrolled")
        grid = QGridLayout(inside)
        grid.setContentsMargins(0, 0, GRID if len(lines) > ROWS else 0, 0)
        grid.setHorizontalSpacing(2 * GRID)
        grid.setVerticalSpacing(GRID)
        grid.setColumnStretch(1, 1)
        for column, text in ((2, self.tr("By reference fruit, g/ml")), (3, self.tr("Typed, g/ml"))):
            grid.addWidget(label(text, "small"), 0, column, Qt.AlignmentFlag.AlignRight)
        for row, line in enumerate(lines, start=1):
            learned = "–" if line.density_g_ml is None else number_text(line.density_g_ml, DIGITS)
            grid.addWidget(KindMarkView(marks[line.kind], MARK_PX), row, 0)
            grid.addWidget(label(kind_name(line.kind), "strong"), row, 1)
            grid.addWidget(label(learned, "dim"), row, 2, Qt.AlignmentFlag.AlignRight)
            grid.addWidget(self.fields[line.kind], row, 3)
        grid.setRowStretch(len(lines) + 1, 1)
        scroll = QScrollArea()
        reach(scroll)
        scroll.setWidgetResizable(True)
        scroll.setFrameShape(QFrame.Shape.NoFrame)
        scroll.setWidget(inside)
        scroll.setMinimumWidth(inside.sizeHint().width() + scroll.verticalScrollBar().sizeHint().width())
        scroll.setMinimumHeight(min(ROWS, len(lines)) * (TOUCH + GRID) + 3 * GRID)
        about = label(
            self.tr(
                "A mass is the volume times the density of the kind. Reference fruit of which you measured volume and "
                "weight teach it; a number typed here stands instead. Empty leaves it to the reference fruit. It holds "
                "from the next lot on."
            ),
            "dim",
        )
        about.setWordWrap(True)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(3 * GRID, 3 * GRID, 3 * GRID, 3 * GRID)
        whole.setSpacing(2 * GRID)
        for widget in (label(self.tr("Density of each kind"), "page"), about, scroll, self._wrong, self._buttons):
            whole.addWidget(widget)

    def _check(self) -> None:
        """Let nothing be saved that no fruit can weigh."""
        wrong = [kind for kind, field in self.fields.items() if field.text() and read_density(field.text()) is None]
        self.save.setEnabled(not wrong)
        self._wrong.setVisible(bool(wrong))
        self._wrong.setText(
            self.tr("{kind}: a density lies between {least} and {most} g/ml; water has 1.").format(
                kind=kind_name(wrong[0]), least=number_text(LIGHTEST_G_ML, 1), most=number_text(HEAVIEST_G_ML, 1)
            )
            if wrong
            else ""
        )
