from __future__ import annotations

import re
import sqlite3
from pathlib import Path

import pytest
from sqlalchemy import MetaData, create_engine

from fruitgui.errors import WorldError
from fruitgui.measurement.sums import USUAL_SHARE
from fruitgui.records import migrating
from fruitgui.records.lot import LotPlan
from fruitgui.records.migrating import PICTURES, RECORDS, Schema, bring_up_to_date
from fruitgui.records.picture_tables import PicturesBase
from fruitgui.records.store import open_store
from fruitgui.records.tables import Base
from tests.unit.station.fruit_made import made_fruit

LATER = """
from alembic import op

revision = "{after}"
down_revision = "{before}"


def upgrade() -> None:
    op.execute("ALTER TABLE lot ADD COLUMN weather VARCHAR NOT NULL DEFAULT 'sun'")
    {then}
"""


def _tables(path: Path) -> set[str]:
    connection = sqlite3.connect(path)
    found = connection.execute("SELECT sql FROM sqlite_master WHERE sql IS NOT NULL AND name NOT LIKE 'alembic%'")
    tables = {re.sub(r"\s+", "", sql) for (sql,) in found}
    connection.close()
    return tables


@pytest.mark.parametrize(
    ("schema", "metadata"), [(RECORDS, Base.metadata), (PICTURES, PicturesBase.metadata)], ids=["records", "pictures"]
)
def test_the_scripts_make_the_tables_that_the_program_uses(tmp_path: Path, schema: Schema, metadata: MetaData) -> None:
    bring_up_to_date(tmp_path / schema.file, schema).close()
    engine = create_engine(f"sqlite:///{tmp_path / 'wanted.sqlite'}")
    metadata.create_all(engine)
    engine.dispose()
    assert _tables(tmp_path / schema.file) == _tables(tmp_path / "wanted.sqlite")
    assert migrating.version_of(tmp_path / schema.file) == schema.version


def _only(folder: Path, version: str) -> Schema:
    """Return the schema as it was at an earlier version."""
    scripts = folder / "earlier"
    scripts.mkdir()
    for script in RECORDS.scripts.glob("v*.py"):
        if script.name[1:5] <= version:
            (scripts / script.name).write_text(script.read_text(encoding="utf-8"), encoding="utf-8")
    return Schema(RECORDS.file, scripts, version)


EVERY_VERSION = sorted(script.name[1:5] for script in RECORDS.scripts.glob("v*.py"))

LOT = (
    "INSERT INTO lot (name, grower, recipe, reference_sensor, size_bands, outlets, note, started_s) "
    "VALUES ('old', '', '', 'kinect_1', '{}', '[]', '', 1.8e9)"
)
FRUIT = (
    "INSERT INTO fruit (lot_id, number, counted_s, machine_kind, kind, counted, volume_m3, views) "
    "VALUES (1, 1, 1.8e9, 'lemon', 'lemon', 1, 1e-4, 7)"
)


def test_the_newest_script_is_the_version_of_the_program() -> None:
    assert EVERY_VERSION[0] == "0001"
    assert EVERY_VERSION[-1] == RECORDS.version


@pytest.mark.parametrize("version", EVERY_VERSION[:-1])
def test_files_of_every_earlier_version_are_opened_with_all_that_is_in_them(tmp_path: Path, version: str) -> None:
    bring_up_to_date(tmp_path / RECORDS.file, _only(tmp_path, version)).close()
    connection = sqlite3.connect(tmp_path / RECORDS.file)
    connection.execute(LOT)
    connection.execute(FRUIT)
    connection.commit()
    connection.close()
    with open_store(tmp_path) as store:
        lot = store.lots.open_lot()
        assert lot is not None
        (fruit,) = store.fruit.walk(lot.key)
        assert (fruit.kind, fruit.views) == ("lemon", 7)
        assert store.commit(lot.key, made_fruit(1), ()).number == 2
    assert migrating.version_of(tmp_path / RECORDS.file) == RECORDS.version
    assert migrating.version_of(tmp_path / f"records.version-{version}.sqlite") == version
    (tmp_path / "new").mkdir()
    open_store(tmp_path / "new").close()
    assert _tables(tmp_path / RECORDS.file) == _tables(tmp_path / "new" / RECORDS.file)


def _next_version(folder: Path, then: str = "pass") -> Schema:
    """Return a schema with one more script than the program has."""
    scripts = folder / "scripts"
    scripts.mkdir()
    for script in RECORDS.scripts.glob("v*.py"):
        (scripts / script.name).write_text(script.read_text(encoding="utf-8"), encoding="utf-8")
    after = f"{int(RECORDS.version) + 1:04d}"
    (scripts / "later.py").write_text(LATER.format(before=RECORDS.version, after=after, then=then), encoding="utf-8")
    return Schema(RECORDS.file, scripts, after)


def test_an_older_file_is_brought_up_to_date_and_a_copy_stays(tmp_path: Path) -> None:
    with open_store(tmp_path) as store:
        store.lots.start(LotPlan("old"))
    path = tmp_path / RECORDS.file
    bring_up_to_date(path, _next_version(tmp_path)).close()
    connection = sqlite3.connect(path)
    assert connection.execute("SELECT name, weather FROM lot").fetchall() == [("old", "sun")]
    connection.close()
    copy = sqlite3.connect(tmp_path / f"records.version-{RECORDS.version}.sqlite")
    assert copy.execute("SELECT name FROM lot").fetchall() == [("old",)]
    copy.close()


def test_a_step_that_fails_leaves_the_older_file_as_it_was(tmp_path: Path) -> None:
    with open_store(tmp_path) as store:
        store.lots.start(LotPlan("old"))
    before = _tables(tmp_path / RECORDS.file)
    with pytest.raises(WorldError):
        bring_up_to_date(tmp_path / RECORDS.file, _next_version(tmp_path, 'op.execute("SELECT * FROM nothing")'))
    assert _tables(tmp_path / RECORDS.file) == before
    with open_store(tmp_path) as store:
        assert store.lots.open_lot() is not None


def test_a_newer_file_is_refused_and_untouched(tmp_path: Path) -> None:
    open_store(tmp_path).close()
    path = tmp_path / RECORDS.file
    bring_up_to_date(path, _next_version(tmp_path)).close()
    before = path.read_bytes()
    with pytest.raises(WorldError) as caught:
        open_store(tmp_path)
    assert caught.value.code == "store_newer"
    assert path.read_bytes() == before


def test_a_database_of_another_program_is_refused(tmp_path: Path) -> None:
    connection = sqlite3.connect(tmp_path / RECORDS.file)
    connection.execute("CREATE TABLE photos (name)")
    connection.commit()
    connection.close()
    with pytest.raises(WorldError) as caught:
        open_store(tmp_path)
    assert caught.value.code == "store_damaged"


@pytest.mark.parametrize("said", ["0000", "spring", "", None])
def test_a_version_that_never_was_is_damage_and_nothing_is_touched(tmp_path: Path, said: str | None) -> None:
    with open_store(tmp_path) as store:
        store.lots.start(LotPlan("old"))
    path = tmp_path / RECORDS.file
    connection = sqlite3.connect(path)
    connection.execute("DELETE FROM alembic_version" if said is None else "UPDATE alembic_version SET version_num = ?",
                       () if said is None else (said,))  # fmt: skip
    connection.commit()
    connection.close()
    before = path.read_bytes()
    with pytest.raises(WorldError) as caught:
        open_store(tmp_path)
    assert caught.value.code == "store_damaged"
    assert path.read_bytes() == before
    assert not list(tmp_path.glob("pictures.damaged*")), "its pictures are sound"


def test_sums_of_before_take_the_usual_part_of_what_fruit_err_by_for_shared(tmp_path: Path) -> None:
    bring_up_to_date(tmp_path / RECORDS.file, _only(tmp_path, "0003")).close()
    connection = sqlite3.connect(tmp_path / RECORDS.file)
    connection.execute(LOT)
    for number, (std, counted) in enumerate([(3e-6, 1), (4e-6, 1), (9e-6, 0)], start=1):
        connection.execute(
            "INSERT INTO fruit (lot_id, number, counted_s, machine_kind, kind, counted, volume_m3, volume_std_m3, "
            "views) VALUES (1, ?, 1.8e9, 'lemon', 'lemon', ?, 1e-4, ?, 7)",
            (number, counted, std),
        )
    connection.execute("INSERT INTO total VALUES (1, 'lemon', 2, 2, 2e-4, 25e-12, 2e-8, 0, 0, 0, 0)")
    connection.commit()
    connection.close()
    with open_store(tmp_path) as store:
        (total,) = store.lots.totals(1)
        assert total.volume.shared == pytest.approx(USUAL_SHARE * 7e-6)
        assert total.volume_m3.std == pytest.approx(((1 - USUAL_SHARE**2) * 25 + USUAL_SHARE**2 * 49) ** 0.5 * 1e-6)
        store.corrections.leave_out([2])
        (total,) = store.lots.totals(1)
        assert total.volume_m3.std == pytest.approx(3e-6), "one fruit is as sure as it is"
