"""These are witnesses forged for statements that may be false: what a checker accepts of them must be true all the same.

    forgeries     certificates whose statement and witness come from different places, or were changed in several places at once
    false_ones    those of them that the checker accepts and the oracle denies
    unlike        those of which a checker that remembers what it has read and seen says something else than one that does not
    Tally         how many there were, how many the checker accepted, and how many of a sample have a false statement
    main          python -m tests.proofs.forgeries COUNT [SEED]

A forger knows the certificates of true statements, and everything that made one go wrong before: primes that divide an entry, rows of
zeros, rows from elsewhere, windows one off, indices of others. Numbers are changed to what stands elsewhere in the certificate more often
than to anything, for that is where identities hold.
"""

from __future__ import annotations

import copy
import json
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import cycle
from random import Random
from typing import Any

from faultspace.proofs.trust import checker
from faultspace.proofs.trust.structure_certificates import accept
from tests.oracle import premise_holds, truth
from tests.proofs.examples import Certificate

PRIMES = (2, 3, 5, 7, 11, 13, 101, 2**27 - 39, 2**61 - 1)
NUMBERS = (0, 1, -1, 2, -2, 3, 5, "0", "1", "-1", "1/2", "-1/2", "2", "7", "101", "1/101", "00", "-0", "0/3", "4/2", "5/7")


@dataclass
class Tally:
    """This counts forgeries by kind."""

    tried: dict[str, int] = field(default_factory=dict)
    accepted: dict[str, int] = field(default_factory=dict)
    false_statements: int = 0
    sampled: int = 0


def leaves(node: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """The paths of everything below this node, lists and objects among it."""
    for key in node if isinstance(node, dict) else range(len(node)) if isinstance(node, list) else ():
        yield (*path, key)
        yield from leaves(node[key], (*path, key))


def at(node: Any, path: Sequence[Any]) -> Any:
    """Return what stands at the path below the node."""
    for key in path:
        node = node[key]
    return node


def disturb(rng: Random, node: Any) -> None:
    """This makes one change somewhere below the node."""
    paths = list(leaves(node))
    if rng.random() < 0.7:  # what stays of the format
        paths = [path for path in paths if not isinstance(at(node, path), list | dict)] or paths
    if not paths:
        return
    path = rng.choice(paths)
    parent, last, value = at(node, path[:-1]), path[-1], at(node, path)
    if last == "prime":
        parent[last] = rng.choice(PRIMES)
    elif isinstance(value, list):
        match rng.randrange(6):
            case 0 if isinstance(parent, list):
                del parent[last]
            case 1 if isinstance(parent, list):
                parent.insert(last, copy.deepcopy(value))
            case 2:
                parent[last] = copy.deepcopy(at(node, rng.choice([p for p in leaves(node) if isinstance(at(node, p), list)])))
            case 3:
                rng.shuffle(value)
            case 4:
                parent[last] = [0 if not isinstance(x, list | dict) else x for x in value]
            case _:
                parent[last] = value[: rng.randrange(len(value) + 1)]
    elif isinstance(value, dict):
        if isinstance(parent, list):
            parent[last] = copy.deepcopy(rng.choice(parent))
    else:
        alike = [x for p in paths if type(x := at(node, p)) in (int, str)]
        parent[last] = rng.choice(alike) if rng.random() < 0.5 else rng.choice(NUMBERS)
        if type(value) is int and rng.random() < 0.5:
            parent[last] = max(0, value + rng.choice((-1, 1)))


def forgeries(rng: Random, known: Sequence[Certificate], count: int) -> Iterator[Certificate]:
    """Yield so many forged certificates."""
    by_kind = dict[str, list[Certificate]]()
    for certificate in known:
        by_kind.setdefault(certificate["kind"], []).append(certificate)
    kinds = sorted(by_kind)
    for _ in range(count):
        own = by_kind[rng.choice(kinds)]
        one, other = rng.choice(own), rng.choice(own)
        forged = {**one, "statement": copy.deepcopy(one["statement"]), "witness": copy.deepcopy(rng.choice((one, one, other))["witness"])}
        for key in forged["statement"]:
            if rng.random() < 0.1 and key in other["statement"]:
                forged["statement"][key] = copy.deepcopy(other["statement"][key])
        for _ in range(rng.choice((0, 1, 1, 2))):
            disturb(rng, forged["statement"])
        for _ in range(rng.choice((0, 1, 2, 3))):
            disturb(rng, forged["witness"])
        if "second" in forged["statement"] and rng.random() < 0.3:  # both systems alike, or exchanged
            s = forged["statement"]
            s["first"], s["second"] = (s["second"], s["first"]) if rng.random() < 0.5 else (s["first"], copy.deepcopy(s["first"]))
        yield forged


def is_false(certificate: Certificate) -> bool | None:
    """Return whether the oracle denies the statement; None where it is none, or one about what is no field."""
    try:
        if not premise_holds(certificate["kind"], certificate["statement"]):
            return None
        return not truth(certificate["kind"], certificate["statement"])
    except (ValueError, KeyError, TypeError, AttributeError, ZeroDivisionError, IndexError):
        return None


def false_ones(rng: Random, known: Sequence[Certificate], count: int, sample: int = 400) -> tuple[list[Certificate], Tally]:
    """The forged certificates that are accepted and false, or neither true nor said to be an assumption."""
    tally, found, decided = Tally(), list[Certificate](), dict[str, bool | None]()
    for i, forged in enumerate(forgeries(rng, known, count)):
        kind = forged["kind"]
        tally.tried[kind] = tally.tried.get(kind, 0) + 1
        if i % max(1, count // sample) == 0:
            tally.sampled += 1
            tally.false_statements += is_false(forged) is True
        try:
            assumes = checker.verify(forged).assumes
        except (checker.Malformed, checker.Rejected):
            continue
        tally.accepted[kind] = tally.accepted.get(kind, 0) + 1
        key = json.dumps([kind, forged["statement"]], sort_keys=True)
        if key not in decided:
            decided[key] = is_false(forged)
        if decided[key] is True or (decided[key] is None and not assumes):
            found.append(forged)
    return found, tally


def unlike(rng: Random, known: Sequence[Certificate], count: int) -> list[Certificate]:
    """Return the forged certificates of which `accept`, which keeps systems from one to the next, says something else than `verify`.

    Forgeries are about few systems, and each is tried between two that are right.
    """
    found = list[Certificate]()
    for right, forged in zip(cycle(known), forgeries(rng, known, count), strict=False):
        with suppress(checker.Rejected):  # verified under an assumption
            accept(right)
        # `accept` returns a digest, and raises under an assumption.
        said = _words(lambda one: checker.verify(one).assumes, forged), _words(lambda one: not accept(one), forged)
        if said[0] != said[1]:
            found.append(forged)
    return found


def _words(check: Callable[[Certificate], Any], certificate: Certificate) -> str:
    try:
        return "verified under an assumption" if check(certificate) else "verified"
    except (checker.Malformed, checker.Rejected) as error:
        return "verified under an assumption" if str(error).startswith("verified only") else str(error)


def main() -> int:
    """Prints the tally, what was accepted though false, and what a checker that remembers says of as many; 1 where there is such."""
    from tests.proofs.test_mutations import every_certificate

    count, seed = int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 0
    found, tally = false_ones(Random(seed), every_certificate(), count)
    for kind, tried in sorted(tally.tried.items()):
        print(f"{kind}: {tried} tried, {tally.accepted.get(kind, 0)} accepted")
    print(f"{count} forged, {sum(tally.accepted.values())} accepted, {len(found)} of them false;", end=" ")
    print(f"of {tally.sampled} statements {tally.false_statements} are false by the oracle")
    others = unlike(Random(seed), every_certificate(), count)
    print(f"{len(others)} of which a checker that remembers says something else")
    for forged in (*found, *others):
        print(json.dumps(forged))
    return int(bool(found or others))


if __name__ == "__main__":
    sys.exit(main())
