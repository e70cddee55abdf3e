"""All views of one track together: volume and size, and how sure each is."""
