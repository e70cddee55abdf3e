"""The chosen fruit from all sides, its size as fitted, and what a person measured of it."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QLocale, QRectF, QRegularExpression, QSize, Qt, Signal
from PySide6.QtGui import QPainter, QPaintEvent, QRegularExpressionValidator
from PySide6.QtWidgets import QFormLayout, QLabel, QLineEdit, QSizePolicy, QVBoxLayout, QWidget

from fruitgui.gui.numbers import THIN, measured_text, number_text
from fruitgui.gui.steps.teach.grid import paint_view
from fruitgui.gui.steps.teach.tile import Tile
from fruitgui.gui.theme.kinds import UNKNOWN_MARK
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID, TOUCH
from fruitgui.gui.view_pictures import ViewPictures
from fruitgui.gui.widgets.cards import Card, label
from fruitgui.gui.widgets.kind_mark import KindMarkView
from fruitgui.gui.widgets.scrolled import Scrolled
from fruitgui.gui.widgets.worded import Worded
from fruitgui.measurement.fruit import Size
from fruitgui.records.teaching import Brief
from fruitgui.station.report import ML_PER_M3

WIDTH = 296
LARGEST_MEASURE = 99_999.0
STRIP = 72


class ViewsPicture(QWidget):
    """All views of one fruit, one for each sensor: in colour, or their depth."""

    def __init__(self, theme: Theme, *, depth: bool, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._depth = depth
        self._views: tuple[ViewPictures, ...] = ()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        theme.changed.connect(self.update)

    def show_views(self, views: Sequence[ViewPictures]) -> None:
        """Show other views."""
        self._views = tuple(views)
        self.setVisible(bool(views))
        self.updateGeometry()
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size that it wants."""
        width = WIDTH - 4 * GRID
        return QSize(width, round(self._side(width)) + (2 * GRID if self._depth else 0))

    def _side(self, width: float) -> float:
        columns = max(len(self._views), 2)
        return (width - (columns - 1) * GRID / 2) / columns

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it."""
        side = self._side(self.width())
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setFont(self._theme.font("small"))
            for number, view in enumerate(self._views):
                left = number * (side + GRID / 2)
                paint_view(painter, QRectF(left, 0, side, side), view, self._theme, depth=self._depth)
                if not self._depth:
                    continue
                painter.setPen(self._theme.colour("text_dim"))
                name = painter.fontMetrics().elidedText(view.sensor, Qt.TextElideMode.ElideRight, round(side))
                painter.drawText(QRectF(left, side, side, 2 * GRID), Qt.AlignmentFlag.AlignCenter, name)


class MeasureField(QLineEdit):
    """A number above zero with its unit, or nothing."""

    def __init__(self, unit: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.unit = unit
        self.setMinimumHeight(TOUCH)
        self.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.setPlaceholderText(unit)
        self.setValidator(QRegularExpressionValidator(QRegularExpression(r"\d{0,5}([.,]\d{0,2})?"), self))

    def show_value(self, value: float | None) -> None:
        """Show a number, or none."""
        self.setText("" if value is None else number_text(value, 1).rstrip("0").rstrip(",.") if value % 1 else
                     number_text(value, 0))  # fmt: skip

    def value(self) -> float | None:
        """Return the number; None where there is none above zero. A point and a comma are the same."""
        return typed_number(self.text())


def typed_number(text: str) -> float | None:
    """Return what was typed as a number above zero, None where it is none; a point and a comma are the same."""
    value, good = QLocale.c().toDouble(text.strip().replace(",", "."))
    return value if good and 0.0 < value <= LARGEST_MEASURE else None


class SidePanel(Worded, Card):
    """Shows one fruit.

    Attributes:
        measured: a person typed a volume (ml) or a mass (g): fruit's key, volume, mass, None for nothing.
    """

    measured = Signal(int, object, object)

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__("", parent)
        self._key: int | None = None
        self._shown: tuple[float | None, float | None] = (None, None)
        self.setFixedWidth(WIDTH)
        self.mark, self.name = KindMarkView(UNKNOWN_MARK, 28), label("", "title")
        self.views, self.depths = ViewsPicture(theme, depth=False), ViewsPicture(theme, depth=True)
        self.fitted, self.source, self.density = label("", "strong"), label("", "small"), label("", "small")
        self.volume, self.mass = MeasureField("ml"), MeasureField("g")
        self._many = label("", "dim")
        self._labels = {part: QLabel() for part in ("fitted", "volume", "mass")}
        self._about = label("", "small")
        self._lay_out()
        self._say_words()
        for field in (self.volume, self.mass):
            field.editingFinished.connect(self._measure)

    def show_nothing(self) -> None:
        """Show that no fruit is chosen."""
        self._finish_typing()
        self._key = None
        self._body.setVisible(False)
        self._many.setText(self.tr("Choose a fruit to see it from all sides."))

    def show_fruit(self, one: Brief, tile: Tile, density_g_ml: float | None, chosen: int) -> None:
        """Show a fruit as far as it is known; its pictures and size follow."""
        if one.key != self._key:
            self._finish_typing()
            self._show_pictures(())
            self.fitted.setText("—")
        self._key = one.key
        self._body.setVisible(True)
        self._many.setText("" if chosen < 2 else self.tr("{count} fruit are chosen; a key names them all.").format(
            count=chosen))  # fmt: skip
        self._many.setVisible(chosen > 1)
        self.mark.show_mark(tile.mark or UNKNOWN_MARK)
        self.mark.setVisible(tile.mark is not None)
        self.name.setText(tile.words or self.tr("Not named yet"))
        self.source.setText(one.source)
        if (one.volume_ml, one.mass_g) != self._shown or not (self.volume.hasFocus() or self.mass.hasFocus()):
            self._shown = (one.volume_ml, one.mass_g)
            self.volume.show_value(one.volume_ml)
            self.mass.show_value(one.mass_g)
        self._show_density(one, density_g_ml)

    def show_views(self, key: int, views: Sequence[ViewPictures], size: Size) -> None:
        """Show a fruit's pictures and what was fitted, if it is still the one."""
        if key == self._key:
            self._show_pictures(views)
            volume = size.volume_m3
            known = volume.value == volume.value
            self.fitted.setText(measured_text(volume.value * ML_PER_M3, volume.std * ML_PER_M3, "ml") if known else "—")

    def _show_pictures(self, views: Sequence[ViewPictures]) -> None:
        self.views.show_views(views)
        self.depths.show_views(views)

    def _lay_out(self) -> None:
        self._body = QWidget()
        column = QVBoxLayout(self._body)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(GRID)
        head = QFormLayout()
        head.setHorizontalSpacing(GRID)
        head.addRow(self.mark, self.name)
        form = QFormLayout()
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.setVerticalSpacing(GRID)
        for part, field in (("fitted", self.fitted), ("volume", self.volume), ("mass", self.mass)):
            form.addRow(self._labels[part], field)
            self._labels[part].setBuddy(field)
            self._labels[part].setMinimumHeight(28)
        for one in (self.name, self._many, self._about, self.density, self.source):
            one.setWordWrap(True)
        column.addLayout(head)
        column.addWidget(self.views)
        column.addLayout(form)
        for widget in (self.density, self.depths, self._about, self.source):
            column.addWidget(widget)
        inside = QWidget()
        whole = QVBoxLayout(inside)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.addWidget(self._many)
        whole.addWidget(self._body)
        whole.addStretch()
        scroll = Scrolled(inside)
        scroll.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.body.addWidget(scroll)

    def _say_words(self) -> None:
        self._labels["fitted"].setText(self.tr("Estimated"))
        self._labels["volume"].setText(self.tr("Volume"))
        self._labels["mass"].setText(self.tr("Weight"))
        for field, name, tip in (
            (self.volume, self.tr("Measured volume, ml"), self.tr("As measured, for example in water (Ctrl+M)")),
            (self.mass, self.tr("Measured weight, g"), self.tr("As weighed")),
        ):
            field.setAccessibleName(name)
            field.setToolTip(tip)
        self._about.setText(self.tr("Measure some fruit of each kind: they correct the volumes, and give the density."))

    def _show_density(self, one: Brief, density_g_ml: float | None) -> None:
        if one.volume_ml and one.mass_g:
            own = f"{number_text(one.mass_g / one.volume_ml, 2)}{THIN}g/ml"
            self.density.setText(self.tr("Density of this fruit: {density}").format(density=own))
        elif density_g_ml is not None:
            text = f"{number_text(density_g_ml, 2)}{THIN}g/ml"
            self.density.setText(self.tr("Density of its kind: {density}").format(density=text))
        else:
            self.density.setText("")
        self.density.setVisible(bool(self.density.text()))

    def _finish_typing(self) -> None:
        """Keep what was typed of the fruit before another takes its place."""
        if self.volume.hasFocus() or self.mass.hasFocus():
            self._measure()

    def _measure(self) -> None:
        said = (self.volume.value(), self.mass.value())
        if self._key is not None and said != self._shown:
            self._shown = said
            self.measured.emit(self._key, *said)
