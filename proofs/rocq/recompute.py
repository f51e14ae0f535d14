"""`faultspace check --rocq`: certificates recomputed by Rocq's kernel.

    recomputed    one Recomputed for each certificate: accepted, rejected, not covered or undecided, and why
    theory        the folder with the compiled files that the checks need
    decided       what the boolean checks of several certificates compute to, in one file
    proved        nothing, where the kernel accepts the theorems about the concrete systems and they rest on no axiom

Accepted means that the theorem about this system went through the kernel, not that a boolean came out true.

Covered, over the rational numbers (kind: theorem, in the file), and over GF(p) and Q(a) by theorems of theory/field_checks (FORMAT.md):
    window-ranks: window_ranks_sound, window_ranks_modulo_sound;
    left-invertible: left_invertible_sound, left_invertible_at_sound                               CheckRanks.v
    behaviour-inclusion: inclusion_sound; behaviour-equality: equality_sound;
    window-equality: window_equality_sound; behaviour-difference: difference_sound                 CheckBehaviors.v
    fault-space: solutions_sound, limit_sound; first-column-only: first_column_sound               CheckSolutions.v
    not-left-invertible: not_left_invertible_sound; inversion-delay: delay_sound, no_delay_sound   CheckInversion.v
    matrix-rank: observability_sound, reachability_sound, toeplitz_sound, window_sound, hankel_sound, excitation_sound   CheckMatrices.v
    finite-zeros: has_finite_zeros_sound; infinite-zeros: has_infinite_zeros_sound   FieldZeros.v, FieldInfiniteZeros.v
    schur-stable: system_stable, not over GF(p); moesp-limit: is_limit_sound, over Q   Stability.v, FieldLimits.v
    input-limit, over Q: is_regression_sound, is_output_error_sound                     FieldInputs.v
    left-invertible-line: is_left_invertible_line_sound                                 FieldLines.v
Not covered are fields that there are not, with a reducible polynomial. Of window-ranks with "nulling" exact rows are recomputed, which are
found anew.

Measured: window-ranks with hints of a dense system with n = 20, m = 2, p = 3 takes Rocq three seconds of processor time, n = 40 six. One
of these goes into loading the theory, another one into asking what the theorem rests on. What takes longer than SECONDS is left undecided.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from ...base.progress import Progress, silent
from ...base.sheets import counted
from ..trust import checker
from .build import CLOSED, BrokenTheory, NotProved, compile_file, compiled_theory, kept_theory
from .export import FILE, HEAD, MODULES, PROOFS, exported, written
from .listed import NotCovered
from .locks import held
from .sources import needs, sources
from .terms import Terms

AT_ONCE, SECONDS = 100, 120.0


@dataclass(frozen=True)
class Recomputed:
    """Rocq says this of one certificate."""

    result: Literal["accepted", "rejected", "not covered", "undecided"]
    reason: str


ACCEPTED = Recomputed("accepted", "the kernel has proved the statement by computation, from no axiom")
REJECTED = Recomputed("rejected", "the check computes to false")


def recomputed(certificates: Sequence[Any], progress: Progress = silent, *, seconds: float = SECONDS) -> list[Recomputed]:
    """Return one answer for each certificate. Rocq is asked about what the checker verifies, and about nothing else: the rest is rejected
    here. Undecided is what takes longer than `seconds`, or too much memory. Raises NoRocq, BrokenTheory (of the theory itself), NotProved
    where the words that statements are made of are not as locked."""
    held(texts := sources())
    compiled = theory(progress, texts)
    results: dict[int, Recomputed] = {}
    terms: dict[int, Terms] = {}
    for i, certificate in enumerate(certificates):
        progress("Rocq: writing certificates", i, len(certificates))
        try:
            terms[i] = exported(certificate)
        except NotCovered as error:
            results[i] = Recomputed("not covered", str(error))
        except (checker.Rejected, checker.Malformed) as error:
            results[i] = Recomputed("rejected", f"by the checker: {error}")
    waiting = list(terms)
    for start in range(0, len(waiting), AT_ONCE):
        progress("Rocq: recomputing certificates", start, len(waiting))
        some = waiting[start : start + AT_ONCE]
        results |= zip(some, _answers([terms[i] for i in some], compiled, seconds), strict=True)
    return [results[i] for i in range(len(certificates))]


def theory(progress: Progress = silent, texts: Mapping[str, str] | None = None) -> Path:
    """Return the folder with the compiled files that the checks need, of these sources (None: as they lie there now). Raises NoRocq,
    BrokenTheory."""
    texts, wanted = dict(sources() if texts is None else texts), set[str]()
    if (whole := kept_theory(texts)) is not None:
        return whole
    required, waiting = needs(texts), [f"{module}.v" for module in MODULES]
    while waiting:
        if (name := waiting.pop()) not in wanted:
            wanted.add(name)
            waiting += required[name]
    return compiled_theory(progress, texts={name: text for name, text in texts.items() if name in wanted})


def decided(terms: Sequence[Terms], compiled: Path, seconds: float = SECONDS) -> list[bool]:
    """Return what the boolean check of each computes to. Raises BrokenTheory, also when it takes longer."""
    parts = [f"Module C{i}.\n{t.opening()}\nEval vm_compute in {t.check}.\nEnd C{i}.\n" for i, t in enumerate(terms)]
    said = compile_file(compiled, "Recomputed.v", HEAD + PROOFS + "".join(parts), seconds=seconds)
    verdicts = [word == "true" for word in re.findall(r"= (true|false)\s+: bool", said)]
    if len(verdicts) != len(terms):
        raise BrokenTheory(f"Rocq gave {counted(len(verdicts), 'answer')} to {counted(len(terms), 'check')}")
    return verdicts


def proved(terms: Sequence[Terms], compiled: Path, seconds: float = SECONDS) -> None:
    """Has the kernel accept the theorem of each. Raises NotProved, also when it takes longer."""
    try:
        said = compile_file(compiled, FILE, written(terms), seconds=seconds)
    except BrokenTheory as error:
        raise NotProved(str(error)) from None
    if said.strip() != CLOSED:
        raise NotProved(f"the theorem rests on more than the kernel: {' '.join(said.split())}")


def _answers(terms: list[Terms], compiled: Path, seconds: float) -> list[Recomputed]:
    """Has all proved at once, since starting Rocq takes seconds, and one after the other where that fails. Only then does it ask what the
    check of one computes to: the checker has verified them all, so that a false one is rare.
    """
    try:
        proved(terms, compiled, seconds)
        return [ACCEPTED] * len(terms)
    except NotProved as error:
        if len(terms) > 1:
            return [one for t in terms for one in _answers([t], compiled, seconds)]
        with suppress(BrokenTheory):
            if decided(terms, compiled, seconds) == [False]:
                return [REJECTED]
        return [Recomputed("undecided", str(error))]
