"""The screen on which a model is trained from what was taught, judged, and taken into use."""
