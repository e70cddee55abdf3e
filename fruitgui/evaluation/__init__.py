"""Accuracy and speed against simulated truth, product mode beside paper mode."""
