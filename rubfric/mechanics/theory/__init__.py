"""What is known without a mesh: closed forms, limits, and the kinematics that a scene needs."""
