"""For each claim of a run that has a refuted reading, its counterexamples, the smallest first: the systems of the certificates, described.

counterexamples   the object: claim -> a list of readings, each with its systems or experiments and the word that tells two of them apart
by_size           the refuted readings whose certificates are at hand: those that are not ours come first, then the smallest systems
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

from ...base.progress import Progress, silent
from ...exact.limits.experiments import read_experiment
from ...exact.limits.filters import Filter
from ...exact.system.systems import read_system, residual_of
from .systems import against, described, matrix

PAIRS = (("first", "second"), ("inner", "outer"))
SUBJECTS = ("system", "first", "second", "inner", "outer", "experiment")
Certificates = Mapping[str, Mapping[str, Any]]


def counterexamples(verdicts: Mapping[str, Any], certificates: Certificates, *, on_progress: Progress = silent) -> dict[str, Any]:
    """Return what there is to show of each claim with a refuted reading that has certificates."""
    found = {}
    for place, claim in enumerate(verdicts["claims"]):
        on_progress("explaining counterexamples", place, len(verdicts["claims"]))
        shown = [{"reading": one["reading"], **_shown(one, certificates)} for one in by_size(claim, certificates)]
        if shown:
            found[claim["id"]] = shown
    return found


def by_size(claim: Mapping[str, Any], certificates: Certificates) -> list[Mapping[str, Any]]:
    """Return the refuted readings of a claim that have a system in a certificate at hand."""
    refuted = [
        (reading["ours"], size, place, reading)
        for place, reading in enumerate(claim["readings"])
        if reading["verdict"] == "REFUTED" and (size := _size(reading, certificates)) is not None
    ]
    return [one[3] for one in sorted(refuted, key=lambda one: one[:3])]


def _size(reading: Mapping[str, Any], certificates: Certificates) -> int | None:
    """Return the sum of n, m and p of the largest system that the certificates are about."""
    sizes = []
    for document in _subjects(reading, certificates).values():
        residual = residual_of(
            read_system({key: value for key, value in document.items() if key in ("A", "F", "C", "G", "n", "m", "p", "field")})
        )
        sizes.append(residual.n + residual.m + residual.p)
    return max(sizes, default=None)


def _subjects(reading: Mapping[str, Any], certificates: Certificates) -> dict[str, Mapping[str, Any]]:
    """Return the different systems and experiments of a reading's certificates, by their text."""
    found: dict[str, Mapping[str, Any]] = {}
    for certificate in _of(reading, certificates):
        for name in SUBJECTS:
            if name in certificate["statement"]:
                document = certificate["statement"][name]
                found.setdefault(json.dumps(document, sort_keys=True), document)
    return found


def _of(reading: Mapping[str, Any], certificates: Certificates) -> Iterator[Mapping[str, Any]]:
    yield from (certificates[one["sha256"]] for one in reading["certificates"] if one["sha256"] in certificates)


def _shown(reading: Mapping[str, Any], certificates: Certificates) -> dict[str, Any]:
    word = None
    for certificate in _of(reading, certificates):
        for pair in PAIRS:
            if word is None and all(name in certificate["statement"] for name in pair):
                first, second = (residual_of(read_system(certificate["statement"][name])) for name in pair)
                word = against(first, second, tuple(f"{name} system" for name in pair))
    subjects = [_subject(document) for document in _subjects(reading, certificates).values()]
    return {"subjects": subjects, "word": word}


def _subject(document: Mapping[str, Any]) -> dict[str, Any]:
    if "u_filter" not in document:
        return described(read_system(dict(document)))
    experiment = read_experiment(dict(document))
    filters = (("u", experiment.u_filter), ("v", experiment.v_filter), ("noise", experiment.w_filter))
    return {
        **described(experiment.system),
        "experiment": {
            "s": experiment.s,
            "past": experiment.past,
            "filters": {name: _filter(one) for name, one in filters if one is not None},
        },
    }


def _filter(one: Filter) -> dict[str, Any]:
    """Return the matrices over lag, and the denominator's coefficients."""
    return {"numerator": [matrix(block) for block in one.numerator], "denominator": [str(number) for number in one.denominator]}
