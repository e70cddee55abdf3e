"""Many outlines, trails and ellipses as one path of hair lines.

Each call into Qt gives the line's threads a chance to take Python away for a moment: a picture that is drawn in
thousands of calls is held up thousands of times. And Qt fills wide lines forty times slower than it draws those of one
pixel, so that several of these side by side are the cheaper wide line.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import numpy as np
from PySide6.QtCore import QByteArray, QDataStream
from PySide6.QtGui import QColor, QPainter, QPainterPath, QPen, QTransform

from fruitgui.frame import F32, F64
from fruitgui.station.live.state import Spread

CORNERS = 24
"""Of an ellipse: no corner of one as large as a hand can be told from the curve."""

LEAST_PX = 2.0
"""Half axes of ellipses are drawn no shorter: one too small to be seen is a point."""

STEP_PX = 1.5
"""Points of an outline lie so far apart on the screen, or farther."""

# Qt's own form of a path in a data stream: what and where each element is, big end first.
_ELEMENT = np.dtype([("what", ">i4"), ("x", ">f8"), ("y", ">f8")])
_MOVE, _LINE, _WINDING = 0, 1, 1

_AROUND = np.array([(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)])
_HERE = np.zeros((1, 2))


def path_of(lines: Sequence[F64], apart: F64 = _HERE, *, closed: bool = False) -> QPainterPath:
    """Return lines (each (K, 2), screen pixels) as one path; what lies in several of them is inside all the same.

    Args:
        apart: (S, 2) shifts, pixels: all lines come once with each.
        closed: each line ends where it began.
    """
    drawn = [one for one in lines if len(one) > 1]
    path = QPainterPath()
    if not drawn:
        return path
    points = np.concatenate([part for one in drawn for part in ((one, one[:1]) if closed else (one,))])
    lengths = [len(one) + closed for one in drawn]
    starts = np.cumsum([0, *lengths[:-1]]) + len(points) * np.arange(len(apart))[:, None]
    placed = (apart[:, None] + points).reshape(-1, 2)
    elements = np.empty(len(placed), _ELEMENT)
    elements["what"], elements["x"], elements["y"] = _LINE, placed[:, 0], placed[:, 1]
    elements["what"][starts.ravel()] = _MOVE
    written = b"".join(
        (len(placed).to_bytes(4, "big"), elements.tobytes(), (0).to_bytes(4, "big"), _WINDING.to_bytes(4, "big"))
    )
    stream = QDataStream(QByteArray(written))
    stream >> path
    return path


def paint_lines(
    painter: QPainter, lines: Sequence[F64], colour: QColor, width: float = 1.0, *, closed: bool = False
) -> None:
    """Draw lines (each (K, 2), screen pixels), at least a device's pixel wide; the brush fills them."""
    hair = 1.0 / painter.device().devicePixelRatioF()
    painter.setPen(QPen(colour, hair))
    apart = _AROUND * ((width - hair) / 2.0) if width > hair else _HERE
    painter.drawPath(path_of(lines, apart, closed=closed))


def on_screen(points: F32 | F64, to_screen: QTransform) -> F64:
    """Return points (K, 2) on the screen, for a view that is neither turned nor sheared."""
    scale, shift = (to_screen.m11(), to_screen.m22()), (to_screen.dx(), to_screen.dy())
    placed: F64 = points.astype(np.float64) * scale + shift
    return placed


def thinned(outline_px: F32, scale: float) -> F32:
    """Return an outline of neighbouring pixels without what is too fine for a screen with `scale` pixels to each."""
    return outline_px[:: max(int(STEP_PX / max(scale, 1e-6)), 1)]


def ellipse(spread: Spread, to_screen: QTransform) -> F64:
    """Return an ellipse of picture or belt coordinates as corners (K, 2) on the screen."""
    scale_x, scale_y = to_screen.m11(), to_screen.m22()
    size = abs(scale_x)
    turned = -spread.angle_rad if scale_y < 0 else spread.angle_rad
    cosine, sine = np.cos(turned), np.sin(turned)
    axes = np.maximum((spread.major * size, spread.minor * size), LEAST_PX)
    centre = (spread.x * scale_x + to_screen.dx(), spread.y * scale_y + to_screen.dy())
    corners: F64 = _circle() * axes @ np.array([[cosine, sine], [-sine, cosine]]) + centre
    return corners


@cache
def _circle() -> F64:
    angles = np.linspace(0.0, 2.0 * np.pi, CORNERS, endpoint=False)
    return np.stack([np.cos(angles), np.sin(angles)], axis=1)
