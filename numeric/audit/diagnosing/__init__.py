"""What is probably wrong with an answer that failed: suspicions, each put to the test by the check itself.

suspicions      what a suspicion is, and the ways to test one, with the calls that a check makes
models, counts, spaces, signals        the suspicions of each function
explaining      the first suspicion of a failed check that stands the test, in a sentence
"""
