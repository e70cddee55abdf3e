"""One sensor's view, made ready for both roles in a pair."""

from __future__ import annotations

from dataclasses import replace

from fruitgui.calibration import borders
from fruitgui.calibration import lines as rails
from fruitgui.calibration.across import brinks
from fruitgui.calibration.evidence import Sight
from fruitgui.calibration.fine import Target
from fruitgui.calibration.relief import Relief
from fruitgui.calibration.texture import Skin


class Ready:
    """One relief with what both roles in a pair need, built once per sensor."""

    def __init__(self, relief: Relief) -> None:
        self.relief = relief
        self.sight = Sight(relief)
        self.target = Target(relief)
        self.thin = _thinned(relief, 6)
        self.lines = rails.lines(relief)
        self.borders = borders.borders(relief)
        self.brinks = brinks(relief, self.borders, self.lines)
        self.skin = Skin(relief)


def _thinned(relief: Relief, step: int) -> Relief:
    return replace(
        relief,
        points_m=relief.points_m[::step],
        normals=relief.normals[::step],
        colors=relief.colors[::step],
        thing=relief.thing[::step],
    )
