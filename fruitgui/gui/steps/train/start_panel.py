"""Before training: what is taught, what should be known of it, and which model is in use."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QFont, QPainter, QPaintEvent
from PySide6.QtWidgets import QHBoxLayout, QSizePolicy, QWidget

from fruitgui.classification.intervals import Rate
from fruitgui.gui.kind_words import kind_name
from fruitgui.gui.numbers import count_text
from fruitgui.gui.steps.train.report import interval_text
from fruitgui.gui.theme.kinds import UNKNOWN_MARK, KindMark
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.times import moment_text
from fruitgui.gui.widgets.cards import Card, label, set_health
from fruitgui.gui.widgets.fitting import fitted
from fruitgui.gui.widgets.kind_mark import paint_mark
from fruitgui.gui.widgets.worded import Worded
from fruitgui.records.models import ModelVersion
from fruitgui.station.candidate import Candidate
from fruitgui.station.workflow import FRUIT_PER_KIND, SAMPLES_PER_KIND, TaughtFacts

ROW, MARK, BAR = 44.0, 28.0, 6.0
NAME = 200.0
VERSIONS = 6


class TaughtView(QWidget):
    """A row for each kind, with how much of it is taught."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._kinds: Mapping[str, tuple[int, int]] = {}
        self._marks: Mapping[str, KindMark] = {}
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        theme.changed.connect(self.update)

    def show_kinds(self, kinds: Mapping[str, tuple[int, int]], marks: Mapping[str, KindMark]) -> None:
        """Show other kinds: samples and pieces of each."""
        self._kinds, self._marks = kinds, marks
        self.updateGeometry()
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size that it wants."""
        return QSize(480, round(ROW * max(len(self._kinds), 1)))

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it."""
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            height = min(ROW, self.height() / max(len(self._kinds), 1))
            for number, (kind, (samples, fruit)) in enumerate(self._kinds.items()):
                self._paint(painter, QRectF(0, number * height, self.width(), height), kind, samples, fruit)

    def _paint(self, painter: QPainter, box: QRectF, kind: str, samples: int, fruit: int) -> None:
        theme, middle, left = self._theme, box.center().y(), Qt.AlignmentFlag.AlignVCenter
        side = min(MARK, box.height() - 4)
        paint_mark(painter, QRectF(0, middle - side / 2, side, side), self._marks.get(kind, UNKNOWN_MARK))
        painter.setFont(theme.font("body", QFont.Weight.Medium))
        painter.setPen(theme.colour("text"))
        name = fitted(painter, kind_name(kind), NAME - MARK - GRID)
        painter.drawText(QRectF(MARK + GRID, box.top(), NAME, box.height()), left, name)
        share = min(samples / SAMPLES_PER_KIND, fruit / FRUIT_PER_KIND, 1.0)
        track = QRectF(NAME + 2 * GRID, middle - BAR / 2, max(box.width() - NAME - 24 * GRID, 40.0), BAR)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(theme.colour("line"))
        painter.drawRoundedRect(track, BAR / 2, BAR / 2)
        painter.setBrush(theme.colour("good" if share >= 1.0 else "accent"))
        painter.drawRoundedRect(QRectF(track.left(), track.top(), track.width() * share, BAR), BAR / 2, BAR / 2)
        painter.setFont(theme.font("small"))
        painter.setPen(theme.colour("text_dim"))
        text = self.tr("{fruit} fruit · {samples} views").format(fruit=count_text(fruit), samples=count_text(samples))
        words = QRectF(track.right() + 2 * GRID, box.top(), box.right() - track.right() - 2 * GRID, box.height())
        painter.drawText(words, left, text)


def version_line(version: ModelVersion) -> tuple[str, str]:
    """Return when a model was made, and how it did on fruit held out."""
    return held_out_line(version.made_s, version.held_out)


def held_out_line(made_s: float, held: Mapping[str, Any]) -> tuple[str, str]:
    """Return when something was made (Unix seconds), and how it did on fruit held out."""
    made = moment_text(made_s)
    if not held.get("fruit") or not {"right", "low", "high"} <= held.keys():
        return made, "—"
    rate = Rate(float(held["right"]), float(held["low"]), float(held["high"]), int(held["fruit"]))
    return made, f"{interval_text(rate)} · n = {rate.trials}"


class StartPanel(Worded, QWidget):
    """What is taught at the left, the models at the right."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.taught, self.models = Card(), Card()
        self.kinds = TaughtView(theme)
        self.warning, self.state = label("", "small"), label("", "dim")
        self.waiting = label("", "strong")
        self.versions = [label("") for _ in range(VERSIONS)]
        for one in (self.warning, self.state, self.waiting, *self.versions):
            one.setWordWrap(True)
        set_health(self.warning, "warn")
        self.taught.body.addWidget(self.kinds)
        self.taught.body.addWidget(self.warning)
        self.taught.body.addStretch()
        self.models.body.addWidget(self.waiting)
        self.models.body.addWidget(self.state)
        for one in self.versions:
            self.models.body.addWidget(one)
        self.models.body.addStretch()
        self.models.setFixedWidth(336)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(2 * GRID)
        row.addWidget(self.taught, 1)
        row.addWidget(self.models)
        self._say_words()

    def show_taught(self, taught: TaughtFacts, marks: Mapping[str, KindMark]) -> None:
        """Show what is taught."""
        self.kinds.show_kinds(taught.kinds, marks)
        few = [kind_name(kind) for kind, (samples, fruit) in taught.kinds.items()
               if samples < SAMPLES_PER_KIND or fruit < FRUIT_PER_KIND]  # fmt: skip
        text = self.tr("Few fruit so far: {kinds}. A model can be trained, but show {views} views of {pieces} or more "
                       "fruit of each kind.")  # fmt: skip
        self.warning.setText(
            "" if not few else text.format(kinds=", ".join(few), views=SAMPLES_PER_KIND, pieces=FRUIT_PER_KIND)
        )

    def show_versions(self, versions: Sequence[ModelVersion], in_use: str | None, remark: str) -> None:
        """Show the models that there are, and what should be known of the one in use."""
        self.state.setText(remark)
        self.state.setVisible(bool(remark))
        for line, version in zip(self.versions, [*versions, *[None] * VERSIONS], strict=False):
            line.setVisible(version is not None)
            if version is not None:
                made, right = version_line(version)
                used = version.file == in_use
                name = self.tr("{made}, in use").format(made=made) if used else made
                line.setText(f"{'● ' if used else '○ '}{name}\n     {right}")
                line.setProperty("role", "strong" if used else "dim")

    def show_waiting(self, candidate: Candidate | None) -> None:
        """Show a model that waits to be accepted since before the window was closed."""
        self.waiting.setVisible(candidate is not None)
        if candidate is not None:
            made, right = held_out_line(candidate.facts.made_s, candidate.held_out)
            text = self.tr("Waits to be accepted: {made}").format(made=made)
            self.waiting.setText(f"{text}\n     {right}")

    def _say_words(self) -> None:
        self.taught.set_title(self.tr("What is taught"))
        self.models.set_title(self.tr("Models: right on fruit held out (95 %)"))
