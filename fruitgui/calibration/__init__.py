"""How sensors find each other and the belt, and how far that can be trusted."""
