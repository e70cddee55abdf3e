"""Small JSON files that pydantic describes; fields of a later version are kept as they are."""

from __future__ import annotations

from pathlib import Path
from typing import TypeVar

from pydantic import BaseModel, ConfigDict, ValidationError

from fruitgui.errors import InputError
from fruitgui.files import read_json, write_json

REMEDY = "It was set aside; take the last good one, or begin afresh."


class Written(BaseModel):
    """A record that is kept in a file of its own, or a part of one."""

    model_config = ConfigDict(extra="allow", frozen=True)


W = TypeVar("W", bound=Written)


def read_written(path: Path, of: type[W]) -> W:
    """Return the record in a file.

    Raises:
        InputError: unreadable, not JSON, or a field that cannot be; says which.
    """
    value = read_json(path)
    try:
        return of.model_validate(value)
    except ValidationError as error:
        first = error.errors(include_input=False, include_url=False)[0]
        where = ".".join(str(step)[:80] for step in first["loc"]) or "top level"
        raise InputError("bad_file", f"{path}: {where}: {first['msg']}.", REMEDY, file=path, where=where) from error


def write_written(path: Path, record: Written) -> None:
    """Write a record, whole or not at all.

    Raises:
        WorldError: it cannot be written there.
    """
    write_json(path, record.model_dump(mode="json"))
