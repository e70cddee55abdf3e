"""The operator's window: everything that imports Qt, and nothing that computes."""
