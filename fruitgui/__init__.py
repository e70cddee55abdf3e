"""Measure, sort and count fruit on a belt with several RGB-D sensors.

The folders read in the order of the data's way: sensors, perception,
classification, tracking, measurement, station. Importing the package loads
nothing heavy; every room loads what it needs where it needs it.
"""

__version__ = "0.1.0"
