"""Results as datasets and tables."""
