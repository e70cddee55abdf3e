"""The screen on which a person says what fruit are."""
