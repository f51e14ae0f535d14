"""Settings for every test.

ci          the profile in force: the same examples in every run, nothing remembered between runs
explore     fresh examples and no clock, for looking further: `pytest --hypothesis-profile=explore`
"""

from hypothesis import settings

settings.register_profile("ci", derandomize=True, database=None, deadline=None)
settings.register_profile("explore", derandomize=False, database=None, deadline=None, max_examples=1000)
settings.load_profile("ci")
