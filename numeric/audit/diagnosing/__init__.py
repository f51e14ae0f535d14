"""What is probably wrong with an answer that failed: suspicions, each put to the test by the check itself.

recording       the calls that a check makes, with their answers
suspicions      what a suspicion is, and the ways to test one
models, residuals, ranks, counts, spaces, signals, structures        the suspicions of each function
explaining      the first suspicion of a failed check that stands the test, in a sentence
"""
