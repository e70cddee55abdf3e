"""Of what sort a spell is: sensors that were away, or something else that leaves a lot in doubt."""

from alembic import op

revision = "0005"
down_revision = "0004"


def upgrade() -> None:
    """Make room for it; until now only sensors that were away were written down."""
    op.execute("ALTER TABLE spell ADD COLUMN sort VARCHAR DEFAULT 'away' NOT NULL")
