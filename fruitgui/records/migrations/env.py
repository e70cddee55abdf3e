"""Run by Alembic: takes the connection that `fruitgui.records.migrating` gives."""

from alembic import context

context.configure(connection=context.config.attributes["connection"])
with context.begin_transaction():
    context.run_migrations()
