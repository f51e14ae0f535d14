"""zeros-of-pairs: all good pairs have the same number of zeros, finite and infinite together; how many are finite changes with P."""

from __future__ import annotations

from collections import defaultdict

from ...exact.system.systems import ResidualSystem
from ..evidence.pairs_by_polynomial import PairByPolynomial
from ..verdict.verdicts import Outcome
from ..verdict.workbench import Workbench, certify_records, counterexample
from .one_determinant import show, words


def number(bench: Workbench) -> Outcome:
    """Every good pair has zeta zeros, finite and infinite counted together."""
    records = [e for e in bench.pairs_by_polynomial if e.equal]
    failing = [e for e in records if len(e.zero_polynomial) - 1 + e.infinite_zeros != e.zeta]
    return certify_records(records, failing, words, show)


def split(bench: Workbench) -> Outcome:
    """All good pairs of a system are claimed to have the same number of finite zeros."""
    groups: dict[ResidualSystem, list[PairByPolynomial]] = defaultdict(list)
    for pair in bench.pairs_by_polynomial:
        if pair.equal and pair.system.field.to_json() == "Q":
            groups[pair.system].append(pair)
    records = [pair for pairs in groups.values() for pair in pairs]
    for system in sorted(groups, key=lambda s: (s.n + s.m + s.p, s.n, s.m, s.p)):
        fewest, most = (choose(groups[system], key=lambda e: len(e.zero_polynomial)) for choose in (min, max))
        if len(fewest.zero_polynomial) < len(most.zero_polynomial):
            texts = f"{words(fewest)} has {len(fewest.zero_polynomial) - 1} finite zeros, {words(most)} has {len(most.zero_polynomial) - 1}"
            return counterexample(texts, "n + m + p among the systems whose pairs were judged", [*show(fewest), *show(most)])
    return certify_records(records, [], words, show)
