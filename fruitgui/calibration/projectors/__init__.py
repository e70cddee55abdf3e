"""How long a projector's light takes to settle, and how much two of them blind each other, from a still scene."""
