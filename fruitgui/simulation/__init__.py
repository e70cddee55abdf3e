"""Belts, fruit of known volume and Kinects that do not exist: the same protocol as real ones."""
