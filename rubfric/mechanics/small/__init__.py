"""Small strain, harmonic by harmonic."""
