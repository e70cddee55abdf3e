"""The evidence of a fruit in, its kind out; and how a model of kinds is trained and honestly judged."""
