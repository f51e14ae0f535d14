"""What an audit's results are made into: a few lines for people, files for machines.

causes      failures folded: one entry a cause
words       an entry in words: the answer beside the truth, where it begins to differ, what is probably wrong
versions    of the kit, its vectors, numpy, BLAS and the platform
junit       XML that continuous integration reads
badge       how many checks passed, as an SVG or for shields.io
"""
