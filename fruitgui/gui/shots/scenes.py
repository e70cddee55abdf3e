"""The list of scenes; every step adds its own."""

from __future__ import annotations

from fruitgui.gui.shots.dialogs import SCENES as DIALOGS
from fruitgui.gui.shots.stage import Scene
from fruitgui.gui.shots.trouble import SCENES as TROUBLE
from fruitgui.gui.steps.belt.shots import SCENES as BELT
from fruitgui.gui.steps.calibrate.shots import SCENES as CALIBRATE
from fruitgui.gui.steps.connect.shots import SCENES as CONNECT
from fruitgui.gui.steps.live.shots import SCENES as LIVE
from fruitgui.gui.steps.lots.shots import SCENES as LOTS
from fruitgui.gui.steps.teach.shots import SCENES as TEACH
from fruitgui.gui.steps.train.shots import SCENES as TRAIN

SCENES: tuple[Scene, ...] = (*CONNECT, *CALIBRATE, *BELT, *TEACH, *TRAIN, *LIVE, *LOTS, *DIALOGS, *TROUBLE)
