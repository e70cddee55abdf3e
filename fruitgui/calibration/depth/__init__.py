"""What one device's depth is off by, measured from a flat board at known heights and a ball of known diameter."""
