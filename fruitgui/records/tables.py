"""The tables of `records.sqlite`. Times of day are Unix seconds, UTC; all else is SI, NULL where it is not known.

Every change here needs a migration; a test holds the two together.
"""

from __future__ import annotations

from typing import Any

from sqlalchemy import JSON, ForeignKey, Index, UniqueConstraint, text
from sqlalchemy.orm import DeclarativeBase, Mapped, mapped_column

CORRECTED = text("(counted IS 0 OR kind IS NOT machine_kind)")
"""Of fruit of which a person said something else than the machine; a query in these words uses their index."""


class Base(DeclarativeBase):
    """Of all tables of the records."""

    type_annotation_map = {dict[str, Any]: JSON, list[Any]: JSON}  # noqa: RUF012 - SQLAlchemy reads it so


class StationCopyRow(Base):
    """A station file as it was when a lot ran; the same text is kept once."""

    __tablename__ = "station_copy"

    sha256: Mapped[str] = mapped_column(primary_key=True)
    text: Mapped[str]


class LotRow(Base):
    """A lot."""

    __tablename__ = "lot"
    __table_args__ = (
        # One line runs one lot at a time.
        Index("lot_open", text("(ended_s IS NULL)"), unique=True, sqlite_where=text("ended_s IS NULL")),
        Index("lot_started", "started_s"),
        {"sqlite_autoincrement": True},
    )

    id: Mapped[int] = mapped_column(primary_key=True)
    name: Mapped[str]
    grower: Mapped[str]
    recipe: Mapped[str]
    reference_sensor: Mapped[str]
    station_sha256: Mapped[str | None] = mapped_column(ForeignKey("station_copy.sha256"))
    model: Mapped[str | None]
    size_bands: Mapped[dict[str, Any]]
    outlets: Mapped[list[Any]]
    note: Mapped[str]
    started_s: Mapped[float]
    ended_s: Mapped[float | None]


class PauseRow(Base):
    """A time in which a lot stood still."""

    __tablename__ = "pause"

    id: Mapped[int] = mapped_column(primary_key=True)
    lot_id: Mapped[int] = mapped_column(ForeignKey("lot.id", ondelete="CASCADE"), index=True)
    from_s: Mapped[float]
    to_s: Mapped[float | None]
    why: Mapped[str]


class SpellRow(Base):
    """A time in which sensors gave nothing or too little (`sort`) while a lot ran, and what of the belt nobody saw;
    or other trouble."""

    __tablename__ = "spell"

    id: Mapped[int] = mapped_column(primary_key=True)
    lot_id: Mapped[int] = mapped_column(ForeignKey("lot.id", ondelete="CASCADE"), index=True)
    from_s: Mapped[float]
    to_s: Mapped[float | None]
    sensors: Mapped[list[Any]]
    lanes_m: Mapped[list[Any] | None] = mapped_column(JSON(none_as_null=True))
    width_m: Mapped[float | None]
    share: Mapped[float]
    sort: Mapped[str] = mapped_column(server_default=text("'away'"))


class FruitRow(Base):
    """A counted fruit: what the machine said, and beside it the kind that holds now."""

    __tablename__ = "fruit"
    __table_args__ = (
        UniqueConstraint("lot_id", "number", name="fruit_number"),
        # The kind first: a walk through all kinds of a lot then follows the numbers, as rows lie in the file. With the
        # volume, so that how volumes are spread is read from the index alone.
        Index("fruit_kind", "kind", "lot_id", "counted", "volume_m3"),
        Index("fruit_corrected", "lot_id", "number", sqlite_where=CORRECTED),
        {"sqlite_autoincrement": True},
    )

    id: Mapped[int] = mapped_column(primary_key=True)
    lot_id: Mapped[int] = mapped_column(ForeignKey("lot.id", ondelete="CASCADE"))
    number: Mapped[int]
    line_number: Mapped[int | None]
    counted_s: Mapped[float]
    machine_kind: Mapped[str | None]
    kind_probability: Mapped[float | None]
    kind: Mapped[str]
    counted: Mapped[bool]
    outlet: Mapped[str | None]
    volume_m3: Mapped[float | None]
    volume_std_m3: Mapped[float | None]
    fitted_volume_m3: Mapped[float | None]
    fitted_volume_std_m3: Mapped[float | None]
    paper_volume_m3: Mapped[float | None]
    mass_kg: Mapped[float | None]
    mass_std_kg: Mapped[float | None]
    length_m: Mapped[float | None]
    length_std_m: Mapped[float | None]
    diameter_m: Mapped[float | None]
    diameter_std_m: Mapped[float | None]
    perimeter_m: Mapped[float | None]
    perimeter_std_m: Mapped[float | None]
    coverage: Mapped[float | None]
    spoilt: Mapped[float | None]
    views: Mapped[int]
    first_seen_s: Mapped[float | None]
    last_seen_s: Mapped[float | None]
    volume_shared_m3: Mapped[float | None]
    mass_shared_kg: Mapped[float | None]


class PathRow(Base):
    """Where a fruit went; apart from the fruit, so that going through a lot reads no paths."""

    __tablename__ = "path"

    fruit_id: Mapped[int] = mapped_column(ForeignKey("fruit.id", ondelete="CASCADE"), primary_key=True)
    points: Mapped[bytes]


class CorrectionRow(Base):
    """What a person said against the machine; never changed, the newest holds."""

    __tablename__ = "correction"

    id: Mapped[int] = mapped_column(primary_key=True)
    fruit_id: Mapped[int] = mapped_column(ForeignKey("fruit.id", ondelete="CASCADE"), index=True)
    kind: Mapped[str | None]
    counted: Mapped[bool | None]
    note: Mapped[str]
    who: Mapped[str]
    when_s: Mapped[float]


class TotalRow(Base):
    """Sums over the counted fruit of one kind in one lot, kept in the transaction that changes them."""

    __tablename__ = "total"

    lot_id: Mapped[int] = mapped_column(ForeignKey("lot.id", ondelete="CASCADE"), primary_key=True)
    kind: Mapped[str] = mapped_column(primary_key=True)
    fruit: Mapped[int]
    measured: Mapped[int]
    volume_m3: Mapped[float]
    volume_variance_m6: Mapped[float]
    volume_square_m6: Mapped[float]
    weighed: Mapped[int]
    mass_kg: Mapped[float]
    mass_variance_kg2: Mapped[float]
    mass_square_kg2: Mapped[float]
    volume_shared_m3: Mapped[float] = mapped_column(server_default=text("0"))
    volume_shared_square_m6: Mapped[float] = mapped_column(server_default=text("0"))
    mass_shared_kg: Mapped[float] = mapped_column(server_default=text("0"))
    mass_shared_square_kg2: Mapped[float] = mapped_column(server_default=text("0"))


class TaughtRow(Base):
    """A piece of fruit with its evidence; without a kind while it waits to be named."""

    __tablename__ = "taught"
    __table_args__ = (
        UniqueConstraint("source", "source_fruit", name="taught_fruit"),
        Index("taught_kind", "kind"),
        {"sqlite_autoincrement": True},
    )

    id: Mapped[int] = mapped_column(primary_key=True)
    source: Mapped[str]
    source_fruit: Mapped[str]
    added_s: Mapped[float]
    kind: Mapped[str | None]
    volume_ml: Mapped[float | None]
    mass_g: Mapped[float | None]
    sensors: Mapped[list[Any]]
    alone: Mapped[bool]
    view_features: Mapped[bytes]
    fruit_features: Mapped[bytes]
    volume_m3: Mapped[float | None]
    volume_std_m3: Mapped[float | None]
    length_m: Mapped[float | None]
    length_std_m: Mapped[float | None]
    diameter_m: Mapped[float | None]
    diameter_std_m: Mapped[float | None]
    perimeter_m: Mapped[float | None]
    perimeter_std_m: Mapped[float | None]
    coverage: Mapped[float]
    spoilt: Mapped[float]
    edges: Mapped[dict[str, Any] | None] = mapped_column(JSON(none_as_null=True))


class SampleRow(Base):
    """A view of a taught fruit, by a point on it; its crops lie with the pictures."""

    __tablename__ = "sample"

    id: Mapped[int] = mapped_column(primary_key=True)
    taught_id: Mapped[int] = mapped_column(ForeignKey("taught.id", ondelete="CASCADE"), index=True)
    sensor: Mapped[str]
    time_s: Mapped[float]
    u_px: Mapped[float]
    v_px: Mapped[float]
    radius_px: Mapped[float]
    colour_crop: Mapped[int | None]
    depth_crop: Mapped[int | None]
    outline_crop: Mapped[int | None]


class JournalRow(Base):
    """One step of teaching: done, taken back or done again. Never changed."""

    __tablename__ = "journal"

    id: Mapped[int] = mapped_column(primary_key=True)
    act: Mapped[str]
    step_id: Mapped[int | None]
    changes: Mapped[list[Any]]
    who: Mapped[str]
    when_s: Mapped[float]


class ModelRow(Base):
    """A trained model."""

    __tablename__ = "model"

    id: Mapped[int] = mapped_column(primary_key=True)
    file: Mapped[str] = mapped_column(unique=True)
    made_s: Mapped[float]
    trained_on: Mapped[dict[str, Any]]
    held_out: Mapped[dict[str, Any]]
    note: Mapped[str]


class ModelUseRow(Base):
    """That a model was taken into use; the newest row holds. `before_id` is the use that a roll back returns to."""

    __tablename__ = "model_use"

    id: Mapped[int] = mapped_column(primary_key=True)
    model_id: Mapped[int] = mapped_column(ForeignKey("model.id"))
    before_id: Mapped[int | None] = mapped_column(ForeignKey("model_use.id"))
    when_s: Mapped[float]


class SettingRow(Base):
    """That a setting was given a value; the newest row of a name holds."""

    __tablename__ = "setting"
    __table_args__ = (Index("setting_name", "name", "id"),)

    id: Mapped[int] = mapped_column(primary_key=True)
    name: Mapped[str]
    value: Mapped[Any] = mapped_column(JSON)
    who: Mapped[str]
    when_s: Mapped[float]
