"""The fused cloud with its controls: from where, before or after, and a fade between the sensors."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent
from PySide6.QtWidgets import (
    QButtonGroup,
    QHBoxLayout,
    QPushButton,
    QSizePolicy,
    QSlider,
    QStackedWidget,
    QVBoxLayout,
    QWidget,
)

from fruitgui.gui.steps.calibrate.cloud import Side, sensor_colour
from fruitgui.gui.steps.calibrate.flat_cloud import FlatCloud
from fruitgui.gui.steps.calibrate.gl_cloud import GlCloud, gl_works
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.worded import Worded
from fruitgui.station.fused_cloud import SensorCloud

STEPS = 50
"""Of the slider, from one sensor to the next."""


class CloudView(Worded, QWidget):
    """Three dimensions where the screen can show them; from above and from the side always."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._clouds: tuple[SensorCloud, ...] = ()
        self.flat = FlatCloud(theme)
        self.solid: GlCloud | None = GlCloud(theme) if gl_works() else None
        self._stack = QStackedWidget()
        self.sides = {side: QPushButton() for side in Side}
        self.when = {after: QPushButton() for after in (False, True)}
        self.fade, self.all = QSlider(Qt.Orientation.Horizontal), QPushButton()
        self._names = _Names(theme)
        self._side_group, self._when_group = QButtonGroup(self), QButtonGroup(self)
        self._lay_out()
        self._connect()
        self._say_words()

    @property
    def drawn(self) -> bool:
        """Whether what is to be seen now has been made."""
        seen = self._stack.currentWidget()
        return seen.drawn if isinstance(seen, FlatCloud | GlCloud) else True

    def show_clouds(self, clouds: Sequence[SensorCloud], *, compared: bool) -> None:
        """Show clouds; `compared` offers before and after."""
        self._clouds = tuple(clouds)
        for button in self.when.values():
            button.setVisible(compared)
        self.when[True].setChecked(True)
        self.fade.setRange(0, max(STEPS * (len(self._clouds) - 1), 0))
        self.fade.blockSignals(True)
        self.fade.setValue(self.fade.maximum() // 2)
        self.fade.blockSignals(False)
        self.all.setChecked(True)
        many = len(self._clouds) > 1
        for one in (self.fade, self.all, self._names):
            one.setVisible(many)
        self._names.show_names([cloud.sensor for cloud in self._clouds])
        self.flat.show_clouds(self._clouds)
        if self.solid is not None:
            self.solid.show_clouds(self._clouds)
        self._look()

    def _lay_out(self) -> None:
        self._stack.addWidget(self.flat)
        if self.solid is not None:
            self._stack.addWidget(self.solid)
        top = QHBoxLayout()
        top.setSpacing(GRID // 2)
        for side, button in self.sides.items():
            button.setCheckable(True)
            self._side_group.addButton(button)
            button.setVisible(side is not Side.FREE or self.solid is not None)
            top.addWidget(button)
        top.addStretch()
        for button in self.when.values():
            button.setCheckable(True)
            self._when_group.addButton(button)
            top.addWidget(button)
        (self.sides[Side.FREE] if self.solid is not None else self.sides[Side.TOP]).setChecked(True)
        self.when[True].setChecked(True)
        self.all.setCheckable(True)
        bottom = QHBoxLayout()
        bottom.setSpacing(2 * GRID)
        between = QVBoxLayout()
        between.setSpacing(0)
        between.addWidget(self.fade)
        between.addWidget(self._names)
        bottom.addLayout(between, 1)
        bottom.addWidget(self.all, 0, Qt.AlignmentFlag.AlignTop)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(GRID)
        column.addLayout(top)
        column.addWidget(self._stack, 1)
        column.addLayout(bottom)

    def _connect(self) -> None:
        self._side_group.buttonClicked.connect(self._look)
        self._when_group.buttonClicked.connect(self._look)
        self.fade.valueChanged.connect(self._slide)
        self.all.toggled.connect(self._mix)

    def _say_words(self) -> None:
        sides = {
            Side.FREE: (self.tr("3D"), self.tr("Turn it with the mouse"), "F5"),
            Side.TOP: (self.tr("From above"), self.tr("Look from above"), "F6"),
            Side.SIDE: (self.tr("From the side"), self.tr("Look along the belt's surface"), "F7"),
        }
        for side, (text, tip, key) in sides.items():
            _word(self.sides[side], text, tip, key)
        _word(self.when[False], self.tr("Before"), self.tr("How the sensors were thought to stand before"), "F8")
        _word(self.when[True], self.tr("After"), self.tr("How the sensors stand"), "F9")
        _word(self.all, self.tr("All"), self.tr("Show all sensors at once"), "F4")
        self.fade.setToolTip(self.tr("Fade from sensor to sensor: where they agree, nothing jumps"))
        self.fade.setAccessibleName(self.tr("Fade between the sensors"))

    def _look(self) -> None:
        side = next(side for side, button in self.sides.items() if button.isChecked())
        after = self.when[True].isChecked()
        self.flat.look(side, after=after)
        if self.solid is not None:
            self.solid.look(after=after)
            self._stack.setCurrentWidget(self.solid if side is Side.FREE else self.flat)
        self._mix()

    def _slide(self) -> None:
        self.all.setChecked(False)
        self._mix()

    def _mix(self) -> None:
        at = None if self.all.isChecked() else self.fade.value() / STEPS
        self.flat.fade(at)
        if self.solid is not None:
            self.solid.fade(at)


class _Names(QWidget):
    """The sensors' names below the slider, each where it stands alone, in its colour."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._names: list[str] = []
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setFixedHeight(20)

    def show_names(self, names: Sequence[str]) -> None:
        self._names = list(names)
        self.update()

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setFont(self._theme.font("small"))
            count = len(self._names)
            for number, name in enumerate(self._names):
                width = painter.fontMetrics().horizontalAdvance(name) + 16.0
                middle = 12 + (self.width() - 24) * (number / max(count - 1, 1))
                left = min(max(middle - width / 2, 0.0), self.width() - width)
                painter.setPen(Qt.PenStyle.NoPen)
                painter.setBrush(QColor(sensor_colour(number)))
                painter.drawEllipse(QRectF(left, 5, 10, 10))
                painter.setPen(self._theme.colour("text_dim"))
                painter.drawText(QRectF(left + 14, 0, width, 20), Qt.AlignmentFlag.AlignVCenter, name)


def _word(button: QPushButton, text: str, tip: str, key: str) -> None:
    button.setText(text)
    button.setShortcut(key)
    button.setToolTip(f"{tip} ({key})")
    button.setAccessibleName(text)
