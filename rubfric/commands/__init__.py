"""Commands of the shell, a module each; ``rubfric.cli`` puts them together."""
