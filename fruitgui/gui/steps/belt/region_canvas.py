"""A view of the belt with the region drawn over it; its corners are dragged, or moved with the keys."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QImage,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPainterPath,
    QPaintEvent,
    QPen,
    QPixmap,
    QPolygonF,
    QResizeEvent,
    QTransform,
)
from PySide6.QtWidgets import QSizePolicy, QWidget

from fruitgui.frame import F64
from fruitgui.gui.steps.belt.projection import Projection, grid_lines
from fruitgui.gui.theme.stamps import drawn_pixmap
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import DARK, RADIUS, TOUCH
from fruitgui.gui.widgets.strokes import on_screen, paint_lines, path_of

HANDLE_PX = 9.0
STEP_M, FAR_STEP_M = 0.005, 0.05
EDGE_POINTS = 24
INK = QColor("#ffffff")
LINE = QColor(DARK.accent)
"""Pictures are dark in either theme."""

GRID_INK = QColor(255, 255, 255, 70)
OUTSIDE = QColor(0, 0, 0, 120)

_ARROWS = {
    Qt.Key.Key_Left: (-1.0, 0.0), Qt.Key.Key_Right: (1.0, 0.0), Qt.Key.Key_Up: (0.0, -1.0), Qt.Key.Key_Down: (0.0, 1.0),
}  # fmt: skip


class RegionCanvas(QWidget):
    """Shows a picture and the region in it.

    Attributes:
        dragged: (number of a corner, its new place on the plan (2,), whether it was let go).
        added, removed: a corner's number: one more after it, or without it.
    """

    dragged = Signal(int, object, bool)
    added = Signal(int)
    removed = Signal(int)

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._view: Projection | None = None
        self._image = QImage()
        self._corners_m: F64 = np.zeros((0, 2))
        self._axis_rad = 0.0
        self._arrow_m: tuple[F64, F64] | None = None
        self._held: int | None = None
        self._over: QPixmap | None = None
        self.corner = 0
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(320, 200)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        theme.changed.connect(self._draw_anew)

    @property
    def view(self) -> Projection | None:
        """The view that is shown."""
        return self._view

    def show_view(self, view: Projection) -> None:
        """Show another view; its picture comes by itself."""
        self._view = view
        self._image = QImage()
        self._draw_anew()

    def show_image(self, image: QImage) -> None:
        """Show another picture of the same view."""
        self._image = image
        self.update()

    def show_region(self, corners_m: F64, axis_rad: float, arrow_m: tuple[F64, F64] | None) -> None:
        """Show a region of the plan.

        Args:
            corners_m: (K, 2). axis_rad: heading along which the grid is drawn.
            arrow_m: from and to where on the plan an arrow shows the belt's motion; None for none.
        """
        self._corners_m, self._axis_rad, self._arrow_m = corners_m, axis_rad, arrow_m
        self.corner = min(self.corner, max(len(corners_m) - 1, 0))
        self._draw_anew()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size that it wants."""
        return QSize(640, 420)

    def corner_at(self, place: QPointF) -> int | None:
        """Return the corner under a finger."""
        spots = [(QPointF(spot - place).manhattanLength(), number) for number, spot in self._spots().items()]
        nearest = min(spots, default=(1e9, 0))
        return nearest[1] if nearest[0] <= TOUCH * 0.75 else None

    def spot(self, corner: int) -> QPointF | None:
        """Return where a corner is on the screen; None where it is out of sight."""
        return self._spots().get(corner)

    def mousePressEvent(self, event: QMouseEvent) -> None:  # noqa: N802 - Qt's name
        """Take a corner."""
        if event.button() == Qt.MouseButton.LeftButton:
            self._held = self.corner_at(event.position())
            if self._held is not None:
                self.corner = self._held
            self._draw_anew()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:  # noqa: N802 - Qt's name
        """Drag it."""
        self._drag(event.position(), let_go=False)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:  # noqa: N802 - Qt's name
        """Let it go."""
        self._drag(event.position(), let_go=True)
        self._held = None

    def keyPressEvent(self, event: QKeyEvent) -> None:  # noqa: N802 - Qt's name
        """Choose a corner, move it, add or remove one."""
        key, count = Qt.Key(event.key()), len(self._corners_m)
        if key in _ARROWS and count:
            far = bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier)
            self._push(np.array(_ARROWS[key]), FAR_STEP_M if far else STEP_M)
        elif key in (Qt.Key.Key_Space, Qt.Key.Key_N) and count:
            self.corner = (self.corner + 1) % count
            self._draw_anew()
        elif key in (Qt.Key.Key_Insert, Qt.Key.Key_Plus):
            self.added.emit(self.corner)
        elif key in (Qt.Key.Key_Delete, Qt.Key.Key_Minus):
            self.removed.emit(self.corner)
        else:
            super().keyPressEvent(event)

    def event(self, event: QEvent) -> bool:
        """Draw the frame of whoever has the keyboard."""
        if event.type() in (QEvent.Type.FocusIn, QEvent.Type.FocusOut):
            self.update()
        return bool(super().event(event))

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it."""
        with QPainter(self) as painter:
            painter.setRenderHints(QPainter.RenderHint.Antialiasing | QPainter.RenderHint.SmoothPixmapTransform)
            card = QPainterPath()
            card.addRoundedRect(QRectF(self.rect()), RADIUS, RADIUS)
            painter.setClipPath(card)
            painter.fillRect(self.rect(), self._theme.colour("picture"))
            if self._view is not None:
                if not self._image.isNull():
                    painter.drawImage(self._place(self._view), self._image)
                painter.drawPixmap(0, 0, self._region(self._view))
            painter.setClipping(False)
            if self.hasFocus():
                painter.setBrush(Qt.BrushStyle.NoBrush)
                painter.setPen(QPen(self._theme.colour("accent"), 3))
                painter.drawRoundedRect(QRectF(self.rect()).adjusted(1.5, 1.5, -1.5, -1.5), RADIUS, RADIUS)

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        """Draw the region for another size."""
        super().resizeEvent(event)
        self._draw_anew()

    def _draw_anew(self) -> None:
        self._over = None
        self.update()

    def _region(self, view: Projection) -> QPixmap:
        """Return what lies over the pictures; they change many times a second, it hardly ever."""
        if self._over is None:
            ratio = self.devicePixelRatioF()
            self._over = drawn_pixmap(
                self.width(), self.height(), ratio, lambda painter: self._paint_region(painter, view)
            )
        return self._over

    def _place(self, view: Projection) -> QRectF:
        """Return where the view's picture is on the screen."""
        size = QSize(*view.size).scaled(self.size(), Qt.AspectRatioMode.KeepAspectRatio)
        place = QRectF(0, 0, size.width(), size.height())
        place.moveCenter(QRectF(self.rect()).center())
        return place

    def _to_screen(self, view: Projection) -> QTransform:
        place = self._place(view)
        scale = place.width() / view.size[0]
        return QTransform.fromTranslate(place.left(), place.top()).scale(scale, scale)

    def _spots(self) -> dict[int, QPointF]:
        if self._view is None or not len(self._corners_m):
            return {}
        to_screen = self._to_screen(self._view)
        pixels = self._view.seen(self._corners_m)
        return {
            number: to_screen.map(QPointF(float(u), float(v)))
            for number, (u, v) in enumerate(pixels)
            if np.isfinite(u) and np.isfinite(v)
        }

    def _drag(self, place: QPointF, *, let_go: bool) -> None:
        if self._held is None or self._view is None:
            return
        back, _ = self._to_screen(self._view).inverted()
        pixel = back.map(place)
        plan_m = self._view.plan(np.array([[pixel.x(), pixel.y()]]))[0]
        if np.isfinite(plan_m).all():
            self.dragged.emit(self._held, plan_m, let_go)

    def _push(self, way: F64, step_m: float) -> None:
        """Move the chosen corner by a step in the direction of the screen."""
        if self._view is None:
            return
        here_m = self._corners_m[self.corner]
        pixel = self._view.seen(here_m[None])[0]
        there_m = self._view.plan((pixel + 4.0 * way)[None])[0]
        length_m = float(np.linalg.norm(there_m - here_m))
        if np.isfinite(length_m) and length_m > 1e-9:
            self.dragged.emit(self.corner, here_m + (there_m - here_m) * (step_m / length_m), True)

    def _paint_region(self, painter: QPainter, view: Projection) -> None:
        to_screen = self._to_screen(view)
        outline = path_of(_seen_lines(view, to_screen, [_dense(self._corners_m)]), closed=True)
        outside = QPainterPath()
        outside.addRect(self._place(view))
        painter.fillPath(outside.subtracted(outline), OUTSIDE)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        if len(self._corners_m):
            painter.save()
            painter.setClipPath(outline, Qt.ClipOperation.IntersectClip)
            paint_lines(painter, _seen_lines(view, to_screen, grid_lines(self._corners_m, self._axis_rad)), GRID_INK)
            painter.restore()
        painter.setPen(QPen(LINE, 2.5))
        painter.drawPath(outline)
        if self._arrow_m is not None:
            _paint_arrow(painter, *(self._on_screen(view, to_screen, one) for one in self._arrow_m))
        self._paint_handles(painter)

    def _on_screen(self, view: Projection, to_screen: QTransform, plan_m: F64) -> QPointF:
        u, v = view.seen(plan_m[None])[0]
        return to_screen.map(QPointF(float(u), float(v)))

    def _paint_handles(self, painter: QPainter) -> None:
        for number, spot in self._spots().items():
            chosen = number == self.corner
            painter.setPen(QPen(LINE if chosen else QColor("#14191d"), 3.0 if chosen else 2.0))
            painter.setBrush(INK)
            radius = HANDLE_PX + (3.0 if chosen else 0.0)
            painter.drawEllipse(spot, radius, radius)


def _dense(corners_m: F64) -> F64:
    """Return a polygon's edges as many points: a straight edge is bent by a lens, and may leave the picture."""
    if not len(corners_m):
        return corners_m
    steps = np.linspace(0.0, 1.0, EDGE_POINTS, endpoint=False)[:, None]
    following = np.roll(corners_m, -1, axis=0)
    return np.concatenate([a + (b - a) * steps for a, b in zip(corners_m, following, strict=True)])


def _seen_lines(view: Projection, to_screen: QTransform, lines_m: Sequence[F64]) -> list[F64]:
    """Return lines of the plan, each (K, 2), as they are seen on the screen: the points that are in sight."""
    points_m = np.concatenate(lines_m)
    if not len(points_m):
        return []
    seen = on_screen(view.seen(points_m), to_screen)
    lines = np.split(seen, np.cumsum([len(one) for one in lines_m])[:-1])
    return [one[np.isfinite(one).all(axis=1)] for one in lines]


def _paint_arrow(painter: QPainter, start: QPointF, end: QPointF) -> None:
    along = end - start
    length = (along.x() ** 2 + along.y() ** 2) ** 0.5
    if not 8.0 < length < 1e5:
        return
    unit, side = along / length, QPointF(-along.y(), along.x()) / length
    head = QPolygonF([end, end - unit * 20 + side * 11, end - unit * 20 - side * 11])
    for colour, width in ((QColor(0, 0, 0, 170), 8.0), (INK, 4.0)):
        painter.setPen(QPen(colour, width, Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap))
        painter.drawLine(start, end - unit * 16)
        painter.setBrush(colour)
        painter.setPen(
            QPen(colour, width - 3.0, Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap, Qt.PenJoinStyle.RoundJoin)
        )
        painter.drawPolygon(head)
