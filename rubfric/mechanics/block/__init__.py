"""The finite-element block and its contact, in any kinematics."""
