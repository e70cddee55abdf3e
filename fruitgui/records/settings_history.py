"""Which value each setting had, and since when."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from sqlalchemy import Select, select

from fruitgui.records.database import Database
from fruitgui.records.tables import SettingRow


@dataclass(frozen=True, slots=True)
class Setting:
    """A value that a setting was given.

    Attributes:
        name: of the setting.
        value: anything that JSON can hold.
        who: gave it.
        when_s: Unix seconds.
    """

    name: str
    value: Any
    who: str
    when_s: float


class SettingsHistory:
    """The settings' history of a store. What holds now is in the workspace's files; this says since when."""

    def __init__(self, database: Database, now_s: Callable[[], float] = time.time) -> None:
        self._database = database
        self._now_s = now_s

    def note(self, name: str, value: Any, who: str = "") -> None:  # noqa: ANN401 - JSON is any
        """Write down that a setting was given a value; the same value again is no change."""
        with self._database.writing() as session:
            newest = session.scalar(_of(name).limit(1))
            if newest is None or newest.value != value:
                session.add(SettingRow(name=name, value=value, who=who, when_s=self._now_s()))

    def of(self, name: str, count: int = 100) -> tuple[Setting, ...]:
        """Return the newest values of a setting, the newest first."""
        with self._database.reading() as session:
            rows = session.scalars(_of(name).limit(count))
            return tuple(Setting(row.name, row.value, row.who, row.when_s) for row in rows)


def _of(name: str) -> Select[SettingRow]:
    return select(SettingRow).where(SettingRow.name == name).order_by(SettingRow.id.desc())
