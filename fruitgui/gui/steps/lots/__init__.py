"""Lots: what has been run, each fruit of it, corrections by hand, and what one hands on."""
