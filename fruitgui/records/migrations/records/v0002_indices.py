"""Indices that answer for volumes, and for what people corrected."""

from alembic import op

revision = "0002"
down_revision = "0001"


def upgrade() -> None:
    """Make the indices anew."""
    op.execute("DROP INDEX fruit_kind")
    op.execute("CREATE INDEX fruit_kind ON fruit (kind, lot_id, counted, volume_m3)")
    op.execute(
        "CREATE INDEX fruit_corrected ON fruit (lot_id, number) WHERE (counted IS 0 OR kind IS NOT machine_kind)"
    )
