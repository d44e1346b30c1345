"""Rubber: its moduli over frequency, its relaxation, and which branches a scene needs."""
