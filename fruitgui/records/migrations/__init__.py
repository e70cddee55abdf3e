"""How the tables came to be: `records/` and `pictures/` hold one script for each version, run in order by Alembic."""
