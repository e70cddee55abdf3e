"""Arrays and paths as bytes: npy, packed with zlib. Nothing read from the database is ever run."""

from __future__ import annotations

import io
import math
import zlib
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fruitgui.errors import WorldError
from fruitgui.measurement.fruit import Quantity
from fruitgui.tracking.track import PathPoint

MOST_BYTES = 16 * 1024 * 1024
"""No path and no evidence unpacks to more."""

_PATH = np.dtype([("time_s", "<f8"), ("position_m", "<f4", (3,)), ("covariance_m2", "<f4", (6,))])
_UPPER = np.triu_indices(3)


def pack(array: NDArray[Any]) -> bytes:
    """Return an array as bytes."""
    stream = io.BytesIO()
    np.save(stream, array, allow_pickle=False)
    return zlib.compress(stream.getvalue(), 1)


def unpack(data: bytes) -> NDArray[Any]:
    """Return the array that `pack` was given.

    Raises:
        WorldError: these are no such bytes.
    """
    try:
        plain = zlib.decompressobj().decompress(data, MOST_BYTES)
        return np.asarray(np.load(io.BytesIO(plain), allow_pickle=False))
    except (ValueError, EOFError, zlib.error) as error:
        raise _damaged(str(error)) from error


def pack_path(path: Sequence[PathPoint]) -> bytes:
    """Return a path as bytes; positions to some 0.1 µm, times exactly."""
    table = np.zeros(len(path), _PATH)
    for row, point in zip(table, path, strict=True):
        row["time_s"] = point.time_s
        row["position_m"] = point.position_m
        row["covariance_m2"] = point.covariance_m2[_UPPER]
    return pack(table)


def unpack_path(data: bytes) -> tuple[PathPoint, ...]:
    """Return the path that `pack_path` was given.

    Raises:
        WorldError: these are no such bytes.
    """
    table = unpack(data)
    if table.dtype != _PATH:
        raise _damaged("this is no path")
    return tuple(
        PathPoint(float(row["time_s"]), row["position_m"].astype(np.float64), _whole(row["covariance_m2"]))
        for row in table
    )


def _damaged(what: str) -> WorldError:
    return WorldError(
        "numbers_damaged",
        f"Numbers in the records are damaged ({what}).",
        "Restore the last good backup; the other fruit can be used.",
    )


def _whole(upper: NDArray[Any]) -> NDArray[np.float64]:
    covariance = np.zeros((3, 3))
    covariance[_UPPER] = upper
    return covariance + np.triu(covariance, 1).T


def known(value: float | None) -> float | None:
    """Return a number as a column keeps it: none where it is not finite."""
    return None if value is None or not math.isfinite(value) else float(value)


def columns(name: str, quantity: Quantity | None) -> dict[str, float | None]:
    """Return a quantity as its two columns; `name` has {} where `_std` belongs."""
    if quantity is None:
        return {name.format(""): None, name.format("_std"): None}
    return {name.format(""): known(quantity.value), name.format("_std"): known(quantity.std)}


def quantity(value: float | None, std: float | None) -> Quantity | None:
    """Return a quantity from its columns; None where it was not measured, std NaN where that is not known."""
    if value is None:
        return None
    return Quantity(value, math.nan if std is None else std)
