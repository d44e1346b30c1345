"""Steady sliding on areal roads in small strain: Fourier series in the plane, finite elements over the depth."""
