"""Trained models: which there are, which is in use, and back to the one before."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from sqlalchemy import select
from sqlalchemy.orm import Session

from fruitgui.errors import InputError
from fruitgui.records.database import Database
from fruitgui.records.tables import ModelRow, ModelUseRow


@dataclass(frozen=True, slots=True)
class ModelVersion:
    """A trained model.

    Attributes:
        key: unique in the store.
        file: its name, relative to the workspace.
        made_s: Unix seconds.
        trained_on: what it learned from.
        held_out: how it did on fruit held out, as training tells it.
        note: in people's words.
        in_use: whether the line names fruit with it.
    """

    key: int
    file: str
    made_s: float
    trained_on: Mapping[str, Any]
    held_out: Mapping[str, Any]
    note: str
    in_use: bool


class Models:
    """The models of a store. The files themselves belong to the workspace."""

    def __init__(self, database: Database, now_s: Callable[[], float] = time.time) -> None:
        self._database = database
        self._now_s = now_s

    def add(self, file: str, trained_on: Mapping[str, Any], held_out: Mapping[str, Any], note: str = "") -> int:
        """Keep a new version, not in use yet; return its key.

        Raises:
            InputError: a version with this file is there.
            WorldError: it cannot be kept.
        """
        with self._database.writing() as session:
            if session.scalar(select(ModelRow.id).where(ModelRow.file == file)) is not None:
                raise InputError("model_already", f"The model {file} is kept already.", "Give it another name.")
            row = ModelRow(
                file=file, made_s=self._now_s(), trained_on=dict(trained_on), held_out=dict(held_out), note=note
            )
            session.add(row)
            session.flush()
            return row.id

    def use(self, model: int) -> ModelVersion:
        """Take a version into use.

        Raises:
            InputError: there is none of that key.
        """
        with self._database.writing() as session:
            row = _row(session, model)
            now = _use(session)
            if now is None or now.model_id != model:
                before = None if now is None else now.id
                session.add(ModelUseRow(model_id=model, before_id=before, when_s=self._now_s()))
            return _version(row, model)

    def roll_back(self) -> ModelVersion:
        """Take the version into use that was before this one; again and again, back to the first.

        Raises:
            InputError: there was none before.
        """
        with self._database.writing() as session:
            now = _use(session)
            before = None if now is None or now.before_id is None else session.get(ModelUseRow, now.before_id)
            if before is None:
                raise InputError("no_model_before", "No model was in use before this one.", "Choose one of the list.")
            session.add(ModelUseRow(model_id=before.model_id, before_id=before.before_id, when_s=self._now_s()))
            return _version(_row(session, before.model_id), before.model_id)

    def in_use(self) -> ModelVersion | None:
        """Return the version in use; None where none is."""
        return next((one for one in self.versions() if one.in_use), None)

    def versions(self) -> tuple[ModelVersion, ...]:
        """Return all versions, the newest first."""
        with self._database.reading() as session:
            use = _use(session)
            used = None if use is None else use.model_id
            rows = session.scalars(select(ModelRow).order_by(ModelRow.id.desc()))
            return tuple(_version(row, used) for row in rows)


def _use(session: Session) -> ModelUseRow | None:
    return session.scalar(select(ModelUseRow).order_by(ModelUseRow.id.desc()).limit(1))


def _row(session: Session, model: int) -> ModelRow:
    row = session.get(ModelRow, model)
    if row is None:
        raise InputError("no_such_model", f"There is no model with the key {model}.", "Choose one of the list.")
    return row


def _version(row: ModelRow, used: int | None) -> ModelVersion:
    return ModelVersion(row.id, row.file, row.made_s, row.trained_on, row.held_out, row.note, row.id == used)
