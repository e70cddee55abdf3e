"""Where frames come from: one protocol, one file per make, recordings, turn-taking of projectors."""
