"""What the system tells of its USB: where each depth sensor hangs, who holds it, and what is in its way."""
