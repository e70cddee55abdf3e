"""The first version."""

from alembic import op

revision = "0001"
down_revision = None

TABLES = (
    """
    CREATE TABLE journal (
        id INTEGER NOT NULL,
        act VARCHAR NOT NULL,
        step_id INTEGER,
        changes JSON NOT NULL,
        who VARCHAR NOT NULL,
        when_s DOUBLE NOT NULL,
        PRIMARY KEY (id)
    )
    """,
    """
    CREATE TABLE model (
        id INTEGER NOT NULL,
        file VARCHAR NOT NULL,
        made_s DOUBLE NOT NULL,
        trained_on JSON NOT NULL,
        held_out JSON NOT NULL,
        note VARCHAR NOT NULL,
        PRIMARY KEY (id),
        UNIQUE (file)
    )
    """,
    """
    CREATE TABLE setting (
        id INTEGER NOT NULL,
        name VARCHAR NOT NULL,
        value JSON NOT NULL,
        who VARCHAR NOT NULL,
        when_s DOUBLE NOT NULL,
        PRIMARY KEY (id)
    )
    """,
    "CREATE INDEX setting_name ON setting (name, id)",
    """
    CREATE TABLE station_copy (
        sha256 VARCHAR NOT NULL,
        text VARCHAR NOT NULL,
        PRIMARY KEY (sha256)
    )
    """,
    """
    CREATE TABLE taught (
        id INTEGER NOT NULL PRIMARY KEY AUTOINCREMENT,
        source VARCHAR NOT NULL,
        source_fruit VARCHAR NOT NULL,
        added_s DOUBLE NOT NULL,
        kind VARCHAR,
        volume_ml DOUBLE,
        mass_g DOUBLE,
        sensors JSON NOT NULL,
        alone BOOLEAN NOT NULL,
        view_features BLOB NOT NULL,
        fruit_features BLOB NOT NULL,
        volume_m3 DOUBLE,
        volume_std_m3 DOUBLE,
        length_m DOUBLE,
        length_std_m DOUBLE,
        diameter_m DOUBLE,
        diameter_std_m DOUBLE,
        perimeter_m DOUBLE,
        perimeter_std_m DOUBLE,
        coverage DOUBLE NOT NULL,
        spoilt DOUBLE NOT NULL,
        edges JSON,
        CONSTRAINT taught_fruit UNIQUE (source, source_fruit)
    )
    """,
    "CREATE INDEX taught_kind ON taught (kind)",
    """
    CREATE TABLE lot (
        id INTEGER NOT NULL PRIMARY KEY AUTOINCREMENT,
        name VARCHAR NOT NULL,
        grower VARCHAR NOT NULL,
        recipe VARCHAR NOT NULL,
        reference_sensor VARCHAR NOT NULL,
        station_sha256 VARCHAR,
        model VARCHAR,
        size_bands JSON NOT NULL,
        outlets JSON NOT NULL,
        note VARCHAR NOT NULL,
        started_s DOUBLE NOT NULL,
        ended_s DOUBLE,
        FOREIGN KEY(station_sha256) REFERENCES station_copy (sha256)
    )
    """,
    "CREATE UNIQUE INDEX lot_open ON lot ((ended_s IS NULL)) WHERE ended_s IS NULL",
    "CREATE INDEX lot_started ON lot (started_s)",
    """
    CREATE TABLE model_use (
        id INTEGER NOT NULL,
        model_id INTEGER NOT NULL,
        before_id INTEGER,
        when_s DOUBLE NOT NULL,
        PRIMARY KEY (id),
        FOREIGN KEY(model_id) REFERENCES model (id),
        FOREIGN KEY(before_id) REFERENCES model_use (id)
    )
    """,
    """
    CREATE TABLE sample (
        id INTEGER NOT NULL,
        taught_id INTEGER NOT NULL,
        sensor VARCHAR NOT NULL,
        time_s DOUBLE NOT NULL,
        u_px DOUBLE NOT NULL,
        v_px DOUBLE NOT NULL,
        radius_px DOUBLE NOT NULL,
        colour_crop INTEGER,
        depth_crop INTEGER,
        outline_crop INTEGER,
        PRIMARY KEY (id),
        FOREIGN KEY(taught_id) REFERENCES taught (id) ON DELETE CASCADE
    )
    """,
    "CREATE INDEX ix_sample_taught_id ON sample (taught_id)",
    """
    CREATE TABLE fruit (
        id INTEGER NOT NULL PRIMARY KEY AUTOINCREMENT,
        lot_id INTEGER NOT NULL,
        number INTEGER NOT NULL,
        line_number INTEGER,
        counted_s DOUBLE NOT NULL,
        machine_kind VARCHAR,
        kind_probability DOUBLE,
        kind VARCHAR NOT NULL,
        counted BOOLEAN NOT NULL,
        outlet VARCHAR,
        volume_m3 DOUBLE,
        volume_std_m3 DOUBLE,
        fitted_volume_m3 DOUBLE,
        fitted_volume_std_m3 DOUBLE,
        paper_volume_m3 DOUBLE,
        mass_kg DOUBLE,
        mass_std_kg DOUBLE,
        length_m DOUBLE,
        length_std_m DOUBLE,
        diameter_m DOUBLE,
        diameter_std_m DOUBLE,
        perimeter_m DOUBLE,
        perimeter_std_m DOUBLE,
        coverage DOUBLE,
        spoilt DOUBLE,
        views INTEGER NOT NULL,
        first_seen_s DOUBLE,
        last_seen_s DOUBLE,
        CONSTRAINT fruit_number UNIQUE (lot_id, number),
        FOREIGN KEY(lot_id) REFERENCES lot (id) ON DELETE CASCADE
    )
    """,
    "CREATE INDEX fruit_kind ON fruit (lot_id, counted, kind)",
    """
    CREATE TABLE pause (
        id INTEGER NOT NULL,
        lot_id INTEGER NOT NULL,
        from_s DOUBLE NOT NULL,
        to_s DOUBLE,
        why VARCHAR NOT NULL,
        PRIMARY KEY (id),
        FOREIGN KEY(lot_id) REFERENCES lot (id) ON DELETE CASCADE
    )
    """,
    "CREATE INDEX ix_pause_lot_id ON pause (lot_id)",
    """
    CREATE TABLE total (
        lot_id INTEGER NOT NULL,
        kind VARCHAR NOT NULL,
        fruit INTEGER NOT NULL,
        measured INTEGER NOT NULL,
        volume_m3 DOUBLE NOT NULL,
        volume_variance_m6 DOUBLE NOT NULL,
        volume_square_m6 DOUBLE NOT NULL,
        weighed INTEGER NOT NULL,
        mass_kg DOUBLE NOT NULL,
        mass_variance_kg2 DOUBLE NOT NULL,
        mass_square_kg2 DOUBLE NOT NULL,
        PRIMARY KEY (lot_id, kind),
        FOREIGN KEY(lot_id) REFERENCES lot (id) ON DELETE CASCADE
    )
    """,
    """
    CREATE TABLE correction (
        id INTEGER NOT NULL,
        fruit_id INTEGER NOT NULL,
        kind VARCHAR,
        counted BOOLEAN,
        note VARCHAR NOT NULL,
        who VARCHAR NOT NULL,
        when_s DOUBLE NOT NULL,
        PRIMARY KEY (id),
        FOREIGN KEY(fruit_id) REFERENCES fruit (id) ON DELETE CASCADE
    )
    """,
    "CREATE INDEX ix_correction_fruit_id ON correction (fruit_id)",
    """
    CREATE TABLE path (
        fruit_id INTEGER NOT NULL,
        points BLOB NOT NULL,
        PRIMARY KEY (fruit_id),
        FOREIGN KEY(fruit_id) REFERENCES fruit (id) ON DELETE CASCADE
    )
    """,
)


def upgrade() -> None:
    """Make all tables."""
    for table in TABLES:
        op.execute(table)
