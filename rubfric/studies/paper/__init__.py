"""The claims of the paper, judged."""
