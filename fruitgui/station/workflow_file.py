"""Which step was done with what: kept beside the files that the steps made."""

from __future__ import annotations

from pydantic import Field

from fruitgui.station.written import Written


class ModelMark(Written):
    """Fingerprints of the calibration and of the samples that a model was trained with, and the kinds it knows."""

    calibration: str | None = None
    taught: str | None = None
    kinds: tuple[str, ...] = ()


class Marks(Written):
    """What the steps were done with.

    Attributes:
        belt_calibration: the calibration for which a person set the belt; None before that.
        models: by the name that the station gives a model.
        kinds: in the order of the keys that give them on the teaching screen.
    """

    belt_calibration: str | None = None
    models: dict[str, ModelMark] = Field(default_factory=dict)
    kinds: tuple[str, ...] = ()
