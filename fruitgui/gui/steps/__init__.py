"""The seven screens, one folder each."""
