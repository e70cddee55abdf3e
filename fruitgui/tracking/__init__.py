"""From views to fruit: filter, association, tracks."""
