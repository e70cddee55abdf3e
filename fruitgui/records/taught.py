"""What is known of a taught fruit, and how it is read from its rows."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from sqlalchemy import select
from sqlalchemy.orm import Session

from fruitgui.classification.evidence import Evidence
from fruitgui.measurement.fruit import Edges, Quantity, Size
from fruitgui.records.packing import columns, pack, quantity, unpack
from fruitgui.records.tables import SampleRow, TaughtRow

POINTED_PX = 6.0
"""How far from a point on a fruit another surely means the same fruit, where its radius is not known."""


@dataclass(frozen=True, slots=True)
class Sample:
    """One view of a taught fruit.

    Attributes:
        sensor: the sensor's id.
        time_s: capture time of its frame, in that sensor's own clock.
        u_px, v_px: a point on the fruit in the colour image.
        radius_px: how far from that point it still is this fruit.
        colour_crop, depth_crop, outline_crop: numbers of its crops, None where there is none.
    """

    sensor: str
    time_s: float
    u_px: float
    v_px: float
    radius_px: float = POINTED_PX
    colour_crop: int | None = None
    depth_crop: int | None = None
    outline_crop: int | None = None


@dataclass(frozen=True, slots=True, eq=False)
class TaughtFruit:
    """A piece of fruit that is taught, or waits to be named.

    Attributes:
        source: the recording or the lot that it comes from, for people.
        source_fruit: says which piece of fruit of its source it is.
        sensors: ids of the sensors that saw it.
        evidence: for the classifier.
        size: as fitted.
        samples: its views that are worth showing.
        kind: what a person says it is; None while it waits to be named.
        volume_ml, mass_g: as a person measured, or None.
    """

    source: str
    source_fruit: str
    sensors: tuple[str, ...]
    evidence: Evidence
    size: Size
    samples: tuple[Sample, ...]
    kind: str | None = None
    volume_ml: float | None = None
    mass_g: float | None = None


@dataclass(frozen=True, slots=True, eq=False)
class KeptTaught:
    """A taught fruit as it is kept.

    Attributes:
        key: unique in the store.
        added_s: Unix seconds.
        fruit: all else.
    """

    key: int
    added_s: float
    fruit: TaughtFruit


def taught_row(fruit: TaughtFruit, added_s: float) -> TaughtRow:
    """Return the row of a new taught fruit."""
    size, evidence = fruit.size, fruit.evidence
    return TaughtRow(
        source=fruit.source, source_fruit=fruit.source_fruit, added_s=added_s, kind=fruit.kind,
        volume_ml=fruit.volume_ml, mass_g=fruit.mass_g, sensors=list(fruit.sensors), alone=evidence.alone,
        view_features=pack(evidence.view_features), fruit_features=pack(evidence.fruit_features),
        coverage=size.coverage, spoilt=size.spoilt, edges=_edges_value(size.edges),
        **columns("volume{}_m3", size.volume_m3), **columns("length{}_m", size.length_m),
        **columns("diameter{}_m", size.diameter_m), **columns("perimeter{}_m", size.perimeter_m),
    )  # fmt: skip


def sample_row(taught: int, sample: Sample) -> SampleRow:
    """Return the row of a sample."""
    return SampleRow(
        taught_id=taught, sensor=sample.sensor, time_s=sample.time_s, u_px=sample.u_px, v_px=sample.v_px,
        radius_px=sample.radius_px, colour_crop=sample.colour_crop, depth_crop=sample.depth_crop,
        outline_crop=sample.outline_crop,
    )  # fmt: skip


def taught_of(session: Session, rows: Sequence[TaughtRow]) -> list[KeptTaught]:
    """Return rows as taught fruit, with their samples."""
    samples: dict[int, list[Sample]] = {row.id: [] for row in rows}
    for row in session.scalars(select(SampleRow).where(SampleRow.taught_id.in_(samples)).order_by(SampleRow.id)):
        samples[row.taught_id].append(sample_of(row))
    return [KeptTaught(row.id, row.added_s, _fruit(row, tuple(samples[row.id]))) for row in rows]


def sample_of(row: SampleRow) -> Sample:
    """Return a row as a sample."""
    return Sample(
        row.sensor, row.time_s, row.u_px, row.v_px, row.radius_px, row.colour_crop, row.depth_crop, row.outline_crop
    )


def _fruit(row: TaughtRow, samples: tuple[Sample, ...]) -> TaughtFruit:
    evidence = Evidence(
        np.asarray(unpack(row.view_features), np.float32), np.asarray(unpack(row.fruit_features), np.float64),
        row.alone, whole=row.alone,
    )  # fmt: skip
    return TaughtFruit(
        row.source, row.source_fruit, tuple(row.sensors), evidence, _size(row), samples,
        row.kind, row.volume_ml, row.mass_g,
    )  # fmt: skip


def _size(row: TaughtRow) -> Size:
    return Size(
        volume_m3=_or_nan(row.volume_m3, row.volume_std_m3),
        length_m=_or_nan(row.length_m, row.length_std_m),
        diameter_m=_or_nan(row.diameter_m, row.diameter_std_m),
        perimeter_m=_or_nan(row.perimeter_m, row.perimeter_std_m),
        coverage=row.coverage,
        edges=_edges(row.edges),
        spoilt=row.spoilt,
    )


def _or_nan(value: float | None, std: float | None) -> Quantity:
    return quantity(value, std) or Quantity(math.nan, math.nan)


def _edges_value(edges: Edges | None) -> dict[str, Any] | None:
    if edges is None:
        return None
    return {
        "sensors": list(edges.sensors),
        "fattening_px": edges.fattening_px.tolist(),
        "covariance_px2": edges.covariance_px2.tolist(),
        "with_volume_px": edges.with_volume_px.tolist(),
        "with_lengths_px_m": None if edges.with_lengths_px_m is None else edges.with_lengths_px_m.tolist(),
    }


def _edges(value: dict[str, Any] | None) -> Edges | None:
    if value is None:
        return None
    found, spread, volume = (
        np.array(value[name], np.float64) for name in ("fattening_px", "covariance_px2", "with_volume_px")
    )
    lengths = value.get("with_lengths_px_m")
    return Edges(
        tuple(value["sensors"]), found, spread, volume, None if lengths is None else np.array(lengths, np.float64)
    )
