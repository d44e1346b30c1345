"""Measured columns as laboratories and loggers write them: encodings, separators, headings, units, numbers."""
