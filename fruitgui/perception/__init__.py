"""One frame in, the fruit that one sensor saw in it out."""
