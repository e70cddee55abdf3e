from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPainterPath, QPixmap, QPolygonF, QTransform

from fruitgui.gui.theme.stamps import drawn_pixmap, stamp
from fruitgui.gui.widgets.strokes import ellipse, on_screen, paint_lines, path_of, thinned
from fruitgui.station.live.state import Spread

TRIANGLE = np.array([[10.0, 10.0], [60.5, 12.25], [30.0, 70.0]])
LINE = np.array([[-5.0, 3.0], [80.0, 3.0]])


@pytest.mark.parametrize("closed", [False, True])
def test_lines_become_the_path_that_qt_would_make_point_by_point(closed: bool) -> None:
    made = QPainterPath()
    made.setFillRule(Qt.FillRule.WindingFill)
    for points in (TRIANGLE, LINE):
        ends = [*points, points[0]] if closed else points
        made.addPolygon(QPolygonF([QPointF(*one) for one in ends]))
    assert path_of([TRIANGLE, LINE], closed=closed) == made


def test_lines_of_no_length_are_left_out() -> None:
    assert path_of([]).isEmpty()
    assert path_of([np.zeros((0, 2)), np.zeros((1, 2))], closed=True).isEmpty()


@pytest.mark.usefixtures("qapp")
def test_a_wide_line_covers_its_width_and_no_more() -> None:
    image = QImage(100, 100, QImage.Format.Format_RGB32)
    image.fill(0)
    with QPainter(image) as painter:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        paint_lines(painter, [np.array([[10.0, 50.0], [90.0, 50.0]])], QColor("#ffffff"), 2.0)
    lit = [y for y in range(100) if image.pixelColor(50, y).red() > 128]
    assert lit == [49, 50]


def test_an_ellipse_reaches_as_far_as_its_axes_and_points_to_where_it_is_turned() -> None:
    to_screen = QTransform.fromTranslate(100.0, 200.0).scale(2.0, -2.0)
    corners = ellipse(Spread(5.0, 10.0, 8.0, 4.0, np.pi / 4), to_screen) - np.array([110.0, 180.0])
    far = corners[np.argmax(np.linalg.norm(corners, axis=1))]
    assert np.linalg.norm(far) == pytest.approx(16.0)
    assert abs(far[0] + far[1]) < 1e-9, "up on the belt is up on the screen, which counts downwards"
    assert np.linalg.norm(corners, axis=1).min() == pytest.approx(8.0)


def test_an_ellipse_too_small_to_be_seen_is_a_point() -> None:
    corners = ellipse(Spread(0.0, 0.0, 1e-4, 1e-5, 0.3), QTransform())
    assert np.linalg.norm(corners, axis=1) == pytest.approx(2.0)


def test_points_land_where_the_transform_puts_them() -> None:
    to_screen = QTransform.fromTranslate(3.0, 4.0).scale(0.5, -0.5)
    mapped = [to_screen.map(QPointF(*one)) for one in TRIANGLE]
    assert on_screen(TRIANGLE, to_screen) == pytest.approx(np.array([[one.x(), one.y()] for one in mapped]))


def test_outlines_are_thinned_only_where_the_screen_is_coarser() -> None:
    outline = np.zeros((120, 2), np.float32)
    assert len(thinned(outline, 1.0)) == 120
    assert len(thinned(outline, 0.5)) == 40


@pytest.mark.usefixtures("qapp")
def test_a_stamp_is_drawn_once() -> None:
    drawn = []

    def make() -> QPixmap:
        drawn.append(1)
        return drawn_pixmap(10, 6, 2.0, lambda painter: painter.fillRect(0, 0, 10, 6, QColor("#ff0000")))

    first, second = (stamp(("test", "stamp"), make) for _ in range(2))
    assert (len(drawn), first.cacheKey(), first.size().toTuple()) == (1, second.cacheKey(), (20, 12))
    assert second.toImage().pixelColor(19, 11) == QColor("#ff0000")
    stamp(("test", "another"), make)
    assert len(drawn) == 2
