"""Pictures of every screen in every state worth seeing, for people to look at."""
