"""Connect: sensors found, named, put in order, and seen to run."""
