"""The model file, `fruitgui.model/1`: what tells kinds apart, and what corrects volumes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from fruitgui.classification.evidence import FeatureNames
from fruitgui.classification.model import KindModel
from fruitgui.classification.parts import from_parts, to_parts
from fruitgui.errors import InputError
from fruitgui.measurement.correction import VolumeCorrection
from fruitgui.station.archive import REMEDY, read_archive, write_archive

SCHEMA = "fruitgui.model/1"


@dataclass(frozen=True, slots=True, eq=False)
class Model:
    """What training made.

    Attributes:
        kinds: the classifier.
        correction: of volumes, with densities.
        trained_on: what it learned from, for people.
    """

    kinds: KindModel
    correction: VolumeCorrection
    trained_on: Mapping[str, Any] = field(default_factory=dict)


def write_model(path: Path, model: Model) -> None:
    """Write a model, whole or not at all.

    Raises:
        WorldError: it cannot be written there.
    """
    settings, arrays = to_parts(model.kinds)
    manifest = {
        "schema": SCHEMA,
        "kinds": [_kind_value(kind, model) for kind in model.kinds.kinds],
        "classifier": settings,
        "correction": model.correction.to_dict(),
        "trained_on": dict(model.trained_on),
    }
    write_archive(path, manifest, arrays)


def _kind_value(kind: str, model: Model) -> dict[str, Any]:
    density = model.correction.densities.get(kind)
    return {"kind": kind, "density_kg_m3": None if density is None else density.value}


def read_model(path: Path, names: FeatureNames) -> Model:
    """Return the model in a file, which must want the features of these names.

    Raises:
        InputError: unreadable, another version, or any part that cannot be; says which.
    """
    manifest, arrays = read_archive(path)
    if manifest.get("schema") != SCHEMA:
        found = str(manifest.get("schema"))[:80]
        raise InputError(
            "bad_model", f"{path} is not a model of version {SCHEMA} (found {found!r}).", REMEDY,
            file=path, where="schema",
        )  # fmt: skip
    try:
        kinds = from_parts(_object(manifest, "classifier"), arrays, names)
        correction = VolumeCorrection.from_dict(_object(manifest, "correction"))
    except InputError as error:
        raise InputError(error.code, f"{path}: {error.what}", REMEDY, file=path, where=error.where) from error
    return Model(kinds, correction, _object(manifest, "trained_on"))


def _object(manifest: Mapping[str, Any], name: str) -> dict[str, Any]:
    value = manifest.get(name)
    if not isinstance(value, dict):
        raise InputError("bad_model", f"{name} is missing or not an object.", REMEDY, where=name)
    return value
