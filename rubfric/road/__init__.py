"""Roads: height, slope and curvature of the rigid profile."""
