"""Steady sliding: meshes, refinement and error, in any kinematics."""
