"""Measuring how projectors settle and whom they blind, from the window."""
