"""What the screen has done beside the window: measure how the belt moves."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QCoreApplication

from fruitgui.gui.tasks import Job
from fruitgui.progress import Cancelled, Progress
from fruitgui.sensors.feed import Feed
from fruitgui.station.belt_job import measure_belt
from fruitgui.station.belt_setting import PlanMotion, belt_pose
from fruitgui.station.station import Station
from fruitgui.tracking.belt import BeltMotion

translate = QCoreApplication.translate


@dataclass(frozen=True, slots=True, eq=False)
class Motion:
    """What was measured; None where nothing passed that would tell."""

    motion: BeltMotion | None


def measuring(feed: Feed, station: Station) -> Job[Motion]:
    """Return the job of measuring the belt."""

    def job(progress: Progress, cancelled: Cancelled) -> Motion:
        return Motion(measure_belt(feed, station, progress, cancelled))

    return job


def views_text(said: str) -> str:
    """Return what the core says while it measures, in the operator's language."""
    match = re.fullmatch(r"(\d+) views of passing fruit", said)
    if match is None:
        return said
    return translate("Belt", "{count} views of passing fruit").format(count=match[1])


def plan_motion(station: Station, motion: BeltMotion) -> PlanMotion:
    """Return a motion of the reference frame on the plan."""
    vx, vy, _ = belt_pose(station).turn(motion.velocity_m_s)
    return PlanMotion(float(np.hypot(vx, vy)), math.atan2(vy, vx))
