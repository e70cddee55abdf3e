"""Plain array mathematics: rotations, poses with covariance, planes, ellipses, propagation of error."""
