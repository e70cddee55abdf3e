"""The checkup: what is connected, what is wrong with it, and how well it runs."""
