"""The station file, and the line that runs on it."""
