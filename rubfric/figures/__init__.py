"""Figures of a campaign and of its scenes: datasets in, matplotlib figures out; no file is read here."""
