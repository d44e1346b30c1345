"""One job described: what is simulated, how finely, and how it is marched."""
