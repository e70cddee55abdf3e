"""What fruit of a kind err by together, so that sums say how sure they are."""

from alembic import op

revision = "0004"
down_revision = "0003"

USUAL_SHARE = 0.6614378277661477
"""The square root of 1 − 0.75²: the part that fruit share of what an uncorrected fit says of itself."""


def upgrade() -> None:
    """Make room for it; fruit of before did not say, so the usual part of their std is summed up for them."""
    op.execute("ALTER TABLE fruit ADD COLUMN volume_shared_m3 DOUBLE")
    op.execute("ALTER TABLE fruit ADD COLUMN mass_shared_kg DOUBLE")
    for column in ("volume_shared_m3", "volume_shared_square_m6", "mass_shared_kg", "mass_shared_square_kg2"):
        op.execute(f"ALTER TABLE total ADD COLUMN {column} DOUBLE DEFAULT 0 NOT NULL")
    op.execute(
        f"""
        UPDATE total SET
            volume_shared_m3 = {USUAL_SHARE} * summed.volume,
            volume_shared_square_m6 = {USUAL_SHARE**2} * total.volume_variance_m6,
            mass_shared_kg = {USUAL_SHARE} * summed.mass,
            mass_shared_square_kg2 = {USUAL_SHARE**2} * total.mass_variance_kg2
        FROM (
            SELECT lot_id, kind, total(volume_std_m3) AS volume, total(mass_std_kg) AS mass
            FROM fruit WHERE counted GROUP BY lot_id, kind
        ) AS summed
        WHERE summed.lot_id = total.lot_id AND summed.kind = total.kind
        """  # noqa: S608 - two numbers of our own
    )
