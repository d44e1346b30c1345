"""Finite strain, by Newton-Krylov."""
