"""Marching in time: steps, records and saturation, in any kinematics."""
