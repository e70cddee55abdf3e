"""What has been run and taught: lots, fruit, crops, taught fruit, models and settings, in a real database."""
