"""Everything that setting up made: the rig, its surfaces, the belt, and the name of the model's file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from fruitgui.frame import F64, Intrinsics
from fruitgui.geometry.plane import Surface
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rig import Mount, Rig
from fruitgui.sensors.depth_correction import DepthCorrection


@dataclass(frozen=True, slots=True, eq=False)
class StationSensor:
    """One sensor of a station.

    Attributes:
        serial: of the device; empty where unknown.
        pose: from its optical frame into the reference sensor's.
        surface: the belt in its own optical frame.
        clock_offset_s: added to its stamps gives the reference sensor's clock.
        depth_correction: of this device, applied once where frames are read.
        quality: what calibration said of it, for people.
    """

    serial: str
    pose: Pose
    surface: Surface
    clock_offset_s: float = 0.0
    depth_correction: DepthCorrection | None = None
    quality: Mapping[str, object] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, eq=False)
class Station:
    """One belt with its sensors, ready to run.

    Attributes:
        reference: id of the sensor whose optical frame is the frame of reference.
        sensors: by id.
        velocity_m_s: (3,) of the belt in the reference frame; None where the tracks are to tell it.
        model: file name of the model, relative to the station's file; None where untrained.
        fruit_heights_m: of the shortest and the tallest fruit expected on the belt; None for what is usual.
    """

    reference: str
    sensors: Mapping[str, StationSensor]
    velocity_m_s: F64 | None = None
    model: str | None = None
    fruit_heights_m: tuple[float, float] | None = None

    def rig(self, intrinsics: Mapping[str, Intrinsics]) -> Rig:
        """Return the rig of those sensors whose intrinsics are given; the reference keeps its name.

        Where the reference itself is silent the frame of reference stays its own.
        """
        mounts = {
            name: Mount(name, sensor.pose, sensor.surface, intrinsics[name])
            for name, sensor in self.sensors.items()
            if name in intrinsics
        }
        return Rig(self.reference, mounts)
