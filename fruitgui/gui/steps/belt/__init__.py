"""Belt: where on it fruit may be, how it moves, and how tall fruit are."""
