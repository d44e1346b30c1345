"""Questions asked of the results."""
