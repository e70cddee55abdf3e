"""Of `pictures.sqlite`."""
