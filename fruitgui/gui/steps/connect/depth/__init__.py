"""Correcting one sensor's depth, step by step: bare belt, box, ball, and what it comes to."""
