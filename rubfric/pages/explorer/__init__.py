"""One page on a campaign, to be explored in a browser; the only place that imports plotly."""
