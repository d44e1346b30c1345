"""Contact mechanics of the sliding block."""
