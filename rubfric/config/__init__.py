"""From YAML to a campaign; every key is defined once."""
