"""One file a claim, named as its id with underscores; one function a reading, from a Workbench to an Outcome."""
