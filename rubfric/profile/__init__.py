"""Measured roads: reading, cleaning, spectra, mean profile depth, and periodic windows to slide over."""
