"""Settings of all tests."""

from __future__ import annotations

from hypothesis import settings

# The same examples at every run: a failure is then always about the change at hand.
settings.register_profile("repeatable", derandomize=True, deadline=None)
settings.load_profile("repeatable")
