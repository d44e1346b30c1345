"""What Snakemake needs: jobs, reruns, progress and the log of a run."""
