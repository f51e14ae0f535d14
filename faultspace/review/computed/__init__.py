"""What a page shows beside the verdicts of a run, each computed within seconds when the page is made."""
