"""Times in which sensors were away while a lot ran."""

from alembic import op

revision = "0003"
down_revision = "0002"


def upgrade() -> None:
    """Make the table; what was before was not written down."""
    op.execute(
        """
        CREATE TABLE spell (
            id INTEGER NOT NULL,
            lot_id INTEGER NOT NULL,
            from_s DOUBLE NOT NULL,
            to_s DOUBLE,
            sensors JSON NOT NULL,
            lanes_m JSON,
            width_m DOUBLE,
            share DOUBLE NOT NULL,
            PRIMARY KEY (id),
            FOREIGN KEY(lot_id) REFERENCES lot (id) ON DELETE CASCADE
        )
        """
    )
    op.execute("CREATE INDEX ix_spell_lot_id ON spell (lot_id)")
