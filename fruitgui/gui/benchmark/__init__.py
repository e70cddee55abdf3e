"""How quick the window is, and what holds it up."""
