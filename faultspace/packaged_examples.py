"""The systems that come with the package, to try every command on: `example:NAME` names one wherever a system file is expected.

PREFIX         "example:"
DESCRIPTIONS   name -> what is to be seen in it, for systems
EXPERIMENTS    the same for experiments, which `faultspace limit` reads
CLAIMS         the same for files of claims, in TOML, which `faultspace claim` reads
content        the bytes of one, by its name with the prefix
"""

from __future__ import annotations

from difflib import get_close_matches
from importlib import resources

from .base.errors import InvalidInput, shorten

PREFIX = "example:"
DESCRIPTIONS = {
    "paper": "the paper's own example, F an eigenvector of A: exact only over a cubic number field",
    "theorem-1-first": "makes the same outputs as theorem-1-second on one sample, as many as it has states ...",
    "theorem-1-second": "... and other ones on two: equal behaviour on n samples is not enough",
    "proposition-3": "the rank gap is 2 on n - 1 samples and m = 1 only from n on",
    "theorem-3": "a system whose fault space has three columns",
    "theorem-3-bad-pair": "two independent columns out of that space which do not make an equivalent pair",
    "zeros": "a finite zero at 2 and an infinite one of order 1",
    "same-behaviour": "zeros with A + FK in place of A: another system, the same outputs",
}

EXPERIMENTS = {
    "fault-leads-input": "v(k) = u(k+1), white: PI-MOESP finds A and C, and B + AF, D + CF in place of B, D",
    "fault-follows-input": "v(k) = u(k-1) / 2, white: the limit has rank n + 1, and its leading vectors miss the range of O_s",
    "independent-fault": "a coloured fault independent of the input: PI-MOESP finds A, B, C, D, past outputs as instruments do not",
}

CLAIMS = {
    "claims": "ten claims, from one line to longer ones, which `faultspace claim` decides",
    "literature": "statements of the field with their sources, right ones and wrong or loose ones, with their verdicts",
    "papers": "readings of papers as a new user reads them, most of them of abstracts, with their verdicts",
    "pairs": "claims about two systems, with the same A and C or not: how many samples tell them apart",
    "choices": "claims about other fault columns for the same system: which of them make the same outputs",
    "records": "claims about a system with inputs and the data that it made: what a signal has to excite",
    "ledger": "the paper's claims that the language of claims can say, with the verdicts of `faultspace verify`",
}


def content(name: str) -> bytes:
    """Return the file behind `example:NAME`. Raises InvalidInput for a name that is none."""
    stem = name.removeprefix(PREFIX)
    if stem not in DESCRIPTIONS | EXPERIMENTS | CLAIMS:
        known = [*DESCRIPTIONS, *EXPERIMENTS, *CLAIMS]
        near = get_close_matches(stem, known, n=1, cutoff=0.0)[0]
        raise InvalidInput(f"got example {shorten(stem)}, expected one of {', '.join(known)}; try: {PREFIX}{near}")
    ending = "toml" if stem in CLAIMS else "json"
    return resources.files(__package__).joinpath("examples", f"{stem}.{ending}").read_bytes()
