"""One stage of measuring: what to do at the left, what the sensor sees at the right."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QVBoxLayout, QWidget

from fruitgui.frame import Frame
from fruitgui.gui.steps.connect.depth.course import Course, Stage, Typed
from fruitgui.gui.steps.connect.depth.outlook_label import OutlookLabel
from fruitgui.gui.steps.connect.depth.preview import DepthPreview
from fruitgui.gui.steps.connect.depth.sketch import DepthSketch
from fruitgui.gui.steps.connect.depth.words import rules, seen_text, stage_name
from fruitgui.gui.steps.connect.words import Condition
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.cards import Card, label, set_health
from fruitgui.gui.widgets.stepper import Stepper
from fruitgui.gui.widgets.worded import Worded
from fruitgui.station.depth_watch import Sight

LEFT_WIDTH = 408
RANGES_MM = {
    Stage.BELT: (0.0, 4000.0, 5.0),
    Stage.BOARD: (20.0, 1000.0, 5.0),
    Stage.BALL: (30.0, 400.0, 1.0),
    Stage.RAISED: (20.0, 1500.0, 5.0),
}


class MeasurePanel(Worded, QWidget):
    """Shows a stage and takes the length that is typed for it.

    Attributes:
        typed_changed: another length was typed.
    """

    typed_changed = Signal()

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._stage = Stage.BELT
        self.title, self.way = label("", "title"), label("", "small")
        self.sketch, self.preview = DepthSketch(theme), DepthPreview(theme)
        self._rules = label("")
        self._heads = {stage: label("", "dim") for stage in RANGES_MM}
        self.fields = {stage: Stepper(theme, int(stage is not Stage.BELT), "mm") for stage in RANGES_MM}
        self.seen, self.caution, self.outlook = label("", "strong"), label("", "small"), OutlookLabel()
        self._lay_out()
        self.show_typed(Typed())
        self._say_words()

    @property
    def typed(self) -> Typed:
        """What is typed."""
        return Typed(*(self.fields[stage].value for stage in RANGES_MM))

    def show_typed(self, typed: Typed) -> None:
        """Show other lengths."""
        values = (typed.distance_mm, typed.height_mm, typed.diameter_mm, typed.raised_mm)
        for stage, value in zip(RANGES_MM, values, strict=True):
            self.fields[stage].show_value(value)
        self.outlook.show_raise(typed.raised_mm)

    def show_stage(self, course: Course) -> None:
        """Show the stage of a course."""
        self._stage = course.stage
        for stage in RANGES_MM:
            for one in (self._heads[stage], self.fields[stage]):
                one.setVisible(stage is course.stage)
        self.title.setText(self.tr("Depth of {sensor}").format(sensor=course.sensor))
        self.way.setText(_way(course))
        told = rules(course.stage)
        self._rules.setText("\n".join(told))
        self.sketch.show_stage(course.stage, " ".join(told))
        self.outlook.show_course(course)

    def show_frame(self, frame: Frame | None) -> None:
        """Show the newest picture."""
        self.preview.show_frame(frame, cross=self._stage is Stage.BELT)

    def show_sight(self, sight: Sight | None) -> Condition:
        """Show what is seen of what the stage is about; return it in words."""
        told = seen_text(sight, self.typed)
        self.seen.setText(told.word)
        set_health(self.seen, told.health)
        self.preview.show_found(None if sight is None else sight.on)
        return told

    def show_caution(self, text: str) -> None:
        """Say what speaks against measuring now; nothing where nothing does."""
        self.caution.setText(text)
        self.caution.setVisible(bool(text))

    def _lay_out(self) -> None:
        left, right = Card(), Card()
        left.setFixedWidth(LEFT_WIDTH)
        for one in (self._rules, self.caution, *self._heads.values()):
            one.setWordWrap(True)
        set_health(self.caution, "warn")
        for stage, (low, high, step) in RANGES_MM.items():
            self.fields[stage].set_range(low, high, step)
            self.fields[stage].changed.connect(self.typed_changed)
        raised = self.fields[Stage.RAISED]
        raised.changed.connect(lambda: self.outlook.show_raise(raised.value))
        left.body.addWidget(self.title)
        left.body.addWidget(self.way)
        left.body.addWidget(self.sketch)
        left.body.addWidget(self._rules)
        for stage in RANGES_MM:
            left.body.addWidget(self._heads[stage])
            left.body.addWidget(self.fields[stage])
        left.body.addWidget(self.outlook)
        left.body.addStretch()
        left.body.addWidget(self.caution)
        right.body.addWidget(self.preview, 1)
        right.body.addWidget(self.seen)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(2 * GRID)
        column = QVBoxLayout()
        column.addWidget(left)
        row.addLayout(column)
        row.addWidget(right, 1)

    def _say_words(self) -> None:
        fewer, more = self.tr("Less"), self.tr("More")
        for stage, head in (
            (Stage.BELT, self.tr("From the glass to the belt, straight ahead (0: not measured)")),
            (Stage.BOARD, self.tr("Height of the lid over the belt")),
            (Stage.BALL, self.tr("Diameter of the ball")),
            (Stage.RAISED, self.tr("How much higher the sensor is than at first")),
        ):
            self._heads[stage].setText(head)
            self.fields[stage].name(head, head, fewer, more)


def _way(course: Course) -> str:
    """Return the stages in a row, the present one and what was taken marked."""
    counts = {
        Stage.BELT: int(course.belt is not None),
        Stage.BOARD: len(course.boards),
        Stage.BALL: len(course.balls),
        Stage.RAISED: len(course.raised),
    }
    parts = []
    for stage in Stage:
        taken = " ✓" * min(counts.get(stage, 0), 3)
        name = f"{stage_name(stage)}{taken}"
        parts.append(f"▸ {name}" if stage is course.stage else name)
    return "   ·   ".join(parts)
