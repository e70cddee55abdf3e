"""The table of `pictures.sqlite`."""

from __future__ import annotations

from sqlalchemy import Index, UniqueConstraint
from sqlalchemy.orm import DeclarativeBase, Mapped, mapped_column


class PicturesBase(DeclarativeBase):
    """Of all tables of the pictures."""


class CropRow(PicturesBase):
    """One crop. `owner` is `fruit` or `taught`, `owner_id` its key in the records."""

    __tablename__ = "crop"
    __table_args__ = (
        UniqueConstraint("owner", "owner_id", "number", "content", name="crop_key"),
        Index("crop_kept", "owner", "kept_s"),
    )

    id: Mapped[int] = mapped_column(primary_key=True)
    owner: Mapped[str]
    owner_id: Mapped[int]
    number: Mapped[int]
    content: Mapped[str]
    sensor: Mapped[str]
    time_s: Mapped[float]
    left_px: Mapped[int]
    top_px: Mapped[int]
    coding: Mapped[str]
    kept_s: Mapped[float]
    data: Mapped[bytes]
