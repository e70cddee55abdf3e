"""The first version."""

from alembic import op

revision = "0001"
down_revision = None

TABLES = (
    """
    CREATE TABLE crop (
        id INTEGER NOT NULL,
        owner VARCHAR NOT NULL,
        owner_id INTEGER NOT NULL,
        number INTEGER NOT NULL,
        content VARCHAR NOT NULL,
        sensor VARCHAR NOT NULL,
        time_s DOUBLE NOT NULL,
        left_px INTEGER NOT NULL,
        top_px INTEGER NOT NULL,
        coding VARCHAR NOT NULL,
        kept_s DOUBLE NOT NULL,
        data BLOB NOT NULL,
        PRIMARY KEY (id),
        CONSTRAINT crop_key UNIQUE (owner, owner_id, number, content)
    )
    """,
    "CREATE INDEX crop_kept ON crop (owner, kept_s)",
)


def upgrade() -> None:
    """Make all tables."""
    for table in TABLES:
        op.execute(table)
