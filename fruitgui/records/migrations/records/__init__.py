"""Of `records.sqlite`."""
