"""Extreme inputs."""
