"""Calibrate: the sensors find each other and the belt, and a person sees how well."""
