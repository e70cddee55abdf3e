"""How the projectors take turns: a small picture of one round, and what it means for rate and belt speed."""

from __future__ import annotations

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QFontMetricsF, QPainter, QPaintEvent
from PySide6.QtWidgets import QPushButton, QSizePolicy, QWidget

from fruitgui.gui.numbers import THIN, number_text
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.cards import Card, label
from fruitgui.gui.widgets.fitting import fitted
from fruitgui.gui.widgets.worded import Worded
from fruitgui.sensors.turns import Schedule
from fruitgui.station.turn_plan import TurnPlan

ROW, LOW_ROW, LOW_FROM = 18, 14, 5
"""Height of a sensor's row; from so many sensors on they are lower."""

ROUNDS = 2


class TurnPicture(QWidget):
    """One row for each sensor; a bar where its projector is on. Two rounds are shown."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._sensors: tuple[str, ...] = ()
        self._schedule = Schedule()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        theme.changed.connect(self.update)

    def show_schedule(self, sensors: tuple[str, ...], schedule: Schedule) -> None:
        """Show who is on when."""
        if (sensors, schedule) != (self._sensors, self._schedule):
            self._sensors, self._schedule = sensors, schedule
            self.setAccessibleName(" → ".join(" + ".join(slot) for slot in schedule.slots))
            self.updateGeometry()
            self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size that it wants."""
        return QSize(240, max(len(self._sensors), 1) * self._row())

    def _row(self) -> int:
        return ROW if len(self._sensors) < LOW_FROM else LOW_ROW

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it."""
        if not self._schedule.slots:
            return
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        theme, font = self._theme, self._theme.font("small")
        metrics = QFontMetricsF(font)
        names = min(max(metrics.horizontalAdvance(one) for one in self._sensors), self.width() * 0.4) + GRID
        count = ROUNDS * len(self._schedule.slots)
        step = (self.width() - names) / count
        high = self._row()
        for row, sensor in enumerate(self._sensors):
            line = QRectF(0, row * high, names, high)
            painter.setPen(theme.colour("text_dim"))
            painter.setFont(font)
            text = fitted(painter, sensor, names - GRID)
            painter.drawText(line, Qt.AlignmentFlag.AlignVCenter, text)
            painter.setPen(Qt.PenStyle.NoPen)
            always = not self._schedule.alternates(sensor)
            for number in range(count):
                on = always or sensor in self._schedule.slots[number % len(self._schedule.slots)]
                painter.setBrush(theme.colour("accent" if on else "raised"))
                painter.drawRoundedRect(QRectF(names + number * step + 1, row * high + 3, step - 2, high - 6), 3, 3)
        painter.end()


class TurnCard(Worded, Card):
    """The picture with its sentences."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__("", parent)
        self._plan: TurnPlan | None = None
        self._sensors: tuple[str, ...] = ()
        self.picture = TurnPicture(theme)
        self.result, self.why = label("", "strong"), label("", "small")
        for one in (self.result, self.why):
            one.setWordWrap(True)
        self.body.setSpacing(GRID // 2)
        self.body.addWidget(self.picture)
        self.measure = QPushButton()
        self.body.addWidget(self.result)
        self.body.addWidget(self.measure)  # what is to be pressed is in view in a small window, too
        self.body.addWidget(self.why)
        self._say_words()

    def show_plan(self, plan: TurnPlan | None, sensors: tuple[str, ...], *, free: bool = True) -> None:
        """Show the plan; none where no sensor runs. While nothing else needs the sensors, they can be measured."""
        self.measure.setEnabled(free)
        if (plan, sensors) != (self._plan, self._sensors):
            self._plan, self._sensors = plan, sensors
            self._say_words()

    def _say_words(self) -> None:
        plan = self._plan
        self.setVisible(plan is not None)
        if plan is None:
            return
        self.measure.setText(self.tr("Measure the projectors…"))
        self.measure.setToolTip(self.tr("How long each takes to become steady, and who blinds whom"))
        self.measure.setVisible(len(plan.schedule.lights) > 1)
        self.set_title(self.tr("Projectors take turns") if plan.takes_turns else self.tr("Projectors"))
        self.picture.setVisible(plan.takes_turns)
        self.picture.show_schedule(self._sensors, plan.schedule)
        self.result.setText(self._result(plan))
        self.why.setText(self._reason(plan))

    def _result(self, plan: TurnPlan) -> str:
        low, high = (number_text(limit(plan.rates_hz.values()), 1) for limit in (min, max))
        speed = f"{number_text(plan.highest_speed_m_s, 2)}{THIN}m/s"
        if low != high:
            text = self.tr("{low} to {high} pictures a second; belt up to {speed}")
        elif plan.takes_turns:
            text = self.tr("{low} of {nominal} pictures a second each; belt up to {speed}")
        else:
            text = self.tr("{low} pictures a second each; belt up to {speed}")
        nominal = number_text(max(plan.nominal_hz.values()), 1)
        return text.format(low=low, high=high, nominal=nominal, speed=speed)

    def _reason(self, plan: TurnPlan) -> str:
        if plan.clashes:
            pairs = "; ".join(" + ".join(pair) for pair in plan.clashes)
            return self.tr("These blind each other, as a projector of theirs cannot be switched: {pairs}.").format(
                pairs=pairs
            )
        if len(self._sensors) == 1:
            return self.tr("One sensor blinds no other; its projector is always on.")
        if not plan.schedule.lights:
            return self.tr("The light of these sensors does not disturb the others; none has to wait.")
        if not plan.takes_turns:
            return self.tr("No two sensors see the same place; all are on together.")
        if not plan.overlaps_known:
            return self.tr("Until calibration tells which sensors overlap, each is on alone.")
        return self.tr("Sensors that see the same place are never on together.")
