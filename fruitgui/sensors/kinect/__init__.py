"""The Kinect v1 through the distribution's libfreenect: found, opened by serial, read, and let go of."""
