"""The page that a reviewer reads: from the records of a run to one self-contained file, in one direction."""
