"""The poses file: where a sensor was, for the error study."""

from __future__ import annotations

import csv
import io
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from fruitgui.errors import InputError
from fruitgui.files import read_text
from fruitgui.geometry.pose import Pose

COLUMNS = ("time_s", "sensor", "x_m", "y_m", "z_m", "qx", "qy", "qz", "qw")
REMEDY = f"The header must be {','.join(COLUMNS)}."


@dataclass(frozen=True, slots=True, eq=False)
class KnownPose:
    """Where a sensor's colour optical frame was in a fixed frame (sensor → fixed).

    Attributes:
        line: in the file.
        time_s: in the sensor's own clock.
        sensor: its id.
        pose: sensor → fixed.
    """

    line: int
    time_s: float
    sensor: str
    pose: Pose


def read_poses(path: Path) -> tuple[KnownPose, ...]:
    """Return the rows of a poses file.

    Raises:
        InputError: the file cannot be read, or a row that is not a pose, with its line.
    """
    reader = csv.DictReader(io.StringIO(read_text(path), newline=""), strict=True, skipinitialspace=True)
    try:
        missing = [name for name in COLUMNS if name not in (reader.fieldnames or ())]
        if missing:
            raise InputError("bad_poses", f"{path} lacks {', '.join(missing)}.", REMEDY, file=path, where="line 1")
        rows = tuple(_row(path, reader.line_num, row) for row in reader)
    except csv.Error as error:
        where = f"line {reader.line_num}"
        raise InputError("bad_poses", f"{path}: {where}: {error}.", REMEDY, file=path, where=where) from error
    if not rows:
        raise InputError("bad_poses", f"{path} holds no pose.", REMEDY, file=path)
    return rows


def _row(path: Path, line: int, row: dict[str, str | None]) -> KnownPose:
    from scipy.spatial.transform import Rotation

    where = f"line {line}"
    try:
        numbers = {name: float(row[name] or "") for name in COLUMNS if name != "sensor"}
    except ValueError as error:
        raise InputError("bad_poses", f"{path}: {where}: {error}.", REMEDY, file=path, where=where) from error
    quaternion = np.array([numbers[name] for name in ("qx", "qy", "qz", "qw")])
    if not all(map(math.isfinite, numbers.values())) or abs(np.linalg.norm(quaternion) - 1.0) > 1e-2:
        raise InputError(
            "bad_poses", f"{path}: {where}: not a finite pose with a unit quaternion.", REMEDY, file=path, where=where
        )
    translation_m = np.array([numbers["x_m"], numbers["y_m"], numbers["z_m"]])
    pose = Pose(np.asarray(Rotation.from_quat(quaternion).as_matrix(), dtype=np.float64), translation_m)
    return KnownPose(line, numbers["time_s"], (row["sensor"] or "").strip(), pose)
