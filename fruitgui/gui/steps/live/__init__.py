"""The screen that is on for eight hours: what passes, what it is, how much of it there was."""
