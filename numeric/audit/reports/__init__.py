"""What an audit's results are made into: a few lines for people, files for machines.

causes      failures folded, one entry a cause, and in words: the answer beside the truth, where it begins to differ, what is probably wrong
machines    XML that continuous integration reads; how many checks passed, as an SVG or for shields.io
versions    of the kit, its vectors, numpy, BLAS and the platform
"""
