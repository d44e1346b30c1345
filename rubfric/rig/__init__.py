"""The test rig: measured runs reduced to friction over speed and pressure, and a virtual rig to try that on."""
