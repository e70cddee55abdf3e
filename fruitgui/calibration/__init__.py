"""How sensors find each other and the belt: surface, coarse, fine, graph, trust, error study."""
