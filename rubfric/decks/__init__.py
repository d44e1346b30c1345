"""Prony series in the decks of finite-element codes: Abaqus, Ansys and LS-DYNA."""
