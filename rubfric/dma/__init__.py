"""Dynamic mechanical analysis: from measured moduli at several temperatures to a Prony series with shift factors."""
