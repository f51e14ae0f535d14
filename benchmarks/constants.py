"""This measures, on seeds of the user's choice, what the constants of rules are worth, and tells which of them another value would improve.

    python benchmarks/constants.py order|laws|healthy|space [--trials 20] [--seed 1 ..] [--only NAME ..]
        [--samples 1001] [--jobs 1] [--markdown]

    order       LEAD of `numeric/method/model/past_inputs.py`: the order that PI-MOESP reads off a gap
    laws        `numeric/method/ranks/residual_laws.py`: the count of faults in a residual alone
    healthy     `numeric/plant/healthy/healthy_model.py` and `against_healthy.py`: the count against a healthy record
    space       `numeric/method/space/by_likelihood.py`: the number of zeros by likelihood, from a residual alone

What is asked on which records stands in `constants_questions.py`. Every question is asked of the same records with each constant as it is
and multiplied by each factor, so that answers are compared in pairs. An answer is right, undecided or wrong, and may have an error.

The rule, fixed before anything was measured: a factor is better where it makes significantly fewer answers wrong, or, with no more of
them wrong and no fewer right beyond chance, makes significantly more right or most errors smaller. Significant is what a sign test on
the records that changed gives a chance below LEVEL, shared among all factors of all constants of the question; "no more beyond chance"
is a chance above CHANCE by itself. A constant for which no factor is better keeps its value. A factor that is better on one seed is a
finding, and the constant is changed where it is better on that and a fresh one together; several seeds are taken together. --only asks
some constants, at the level that all of them share.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path
from types import ModuleType
from unittest.mock import patch

import joblib
import numpy as np
import scipy.stats

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))  # run from a clone, installed or not

from benchmarks.constants_questions import QUESTIONS, Answer, Constant, Question

LEVEL = 0.01  # that any factor is called better by chance, all of a question together
CHANCE = 0.05  # below which a loss is no chance, each by itself
FACTORS = (0.5, 0.7, 1.4, 2.0)


@dataclass(frozen=True)
class Worth:
    """These are the answers with a constant times a factor, beside those with the constant as it is, record by record."""

    constant: Constant
    factor: float
    usual: Sequence[Answer]
    answers: Sequence[Answer]

    def counted(self, verdict: str) -> int:
        """Return how many answers have this verdict."""
        return sum(one.verdict == verdict for one in self.answers)

    def chance(self, gained: Callable[[Answer], bool]) -> float:
        """Return the chance of as many gains by a sign test, if gains and losses were equally likely."""
        pairs = [(gained(then), gained(now)) for now, then in zip(self.usual, self.answers, strict=True)]
        up, down = sum(a and not b for a, b in pairs), sum(b and not a for a, b in pairs)
        return sign_test(up, down)

    def smaller_errors(self) -> float:
        """Return the chance of as many smaller errors where both answers have one."""
        both = [(now.error, then.error) for now, then in zip(self.usual, self.answers, strict=True)]
        known = [(now, then) for now, then in both if now is not None and then is not None]
        return sign_test(sum(then < now for now, then in known), sum(then > now for now, then in known))

    def better(self, level: float) -> bool:
        """Tell whether the factor is better by the rule of the head, at this level."""
        if self.chance(lambda one: one.verdict != "wrong") < level:
            return True
        no_worse = self.chance(lambda one: one.verdict == "wrong") > CHANCE and self.chance(lambda one: one.verdict != "right") > CHANCE
        return no_worse and min(self.chance(lambda one: one.verdict == "right"), self.smaller_errors()) < level


def sign_test(up: int, down: int) -> float:
    """Return the chance of at least so many ups among ups and downs that are equally likely; 1 where nothing moved."""
    return float(scipy.stats.binom.sf(up - 1, up + down, 0.5)) if up + down else 1.0


def values(constant: Constant) -> list[tuple[float, float | int]]:
    """Return factors with the values that they give: whole numbers of another value where the constant is whole."""
    found: dict[float | int, float] = {}
    for factor in FACTORS:
        value = constant.value * factor
        if isinstance(constant.value, int):
            value = max(round(value), 1)
        if value != constant.value:
            found.setdefault(value, factor)
    return [(factor, value) for value, factor in found.items()]


def with_value(owners: Sequence[ModuleType], name: str, value: float | int, ask: Callable[[], Answer]) -> Answer:
    """Ask while the constant has another value in all modules that use it."""
    with ExitStack() as patches:
        for owner in owners:
            patches.enter_context(patch.object(owner, name, value))
        return ask()


def asked(question: Question, trial: int, seed: int, samples: int) -> Iterator[tuple[str, float, Answer]]:
    """Yield the answers of one trial's records by constant and factor; the factor 1 stands under no name."""
    for ask in question.records(trial, seed, samples):
        yield "", 1.0, ask()
        for constant in question.constants:
            for factor, value in values(constant):
                yield constant.name, factor, with_value(constant.owners, constant.name, value, ask)


def worths(question: Question, trials: int, seeds: Sequence[int], samples: int, jobs: int) -> list[Worth]:
    """Ask everything of all records and pair the answers."""
    answers: dict[tuple[str, float], list[Answer]] = {}
    run = joblib.Parallel(n_jobs=jobs, verbose=1)
    draws = [(trial, seed) for seed in seeds for trial in range(trials)]
    for part in run(joblib.delayed(lambda *given: list(asked(*given)))(question, trial, seed, samples) for trial, seed in draws):
        for name, factor, answer in part:
            answers.setdefault((name, factor), []).append(answer)
    usual = answers["", 1.0]
    pairs = [(constant, factor) for constant in question.constants for factor, _ in values(constant)]
    return [Worth(constant, factor, usual, answers[constant.name, factor]) for constant, factor in pairs]


def table(question: Question, found: Sequence[Worth], level: float, asked_of: str, markdown: bool) -> Iterator[str]:
    """Yield the lines: right/wrong by constant and factor, and what the rule says of each constant."""
    usual = found[0].usual
    now = Worth(question.constants[0], 1.0, usual, usual)
    yield f"{question.name}: {len(usual)} {asked_of}; as it is {now.counted('right')} right, " + (
        f"{now.counted('undecided')} undecided, {now.counted('wrong')} wrong; below: right/wrong"
    )
    errors = [one.error for one in usual if one.error is not None]
    if errors:
        yield f"median error of {len(errors)}: {np.median(errors):.3g}"
    row = "| {} |" if markdown else "{}"
    yield row.format(" | ".join(("constant", "value", *(f"x {factor:g}" for factor in FACTORS), "the rule says")))
    if markdown:
        yield "|---" * (3 + len(FACTORS)) + "|"
    for constant in question.constants:
        own = {one.factor: one for one in found if one.constant is constant}
        cells = [f"{own[factor].counted('right')}/{own[factor].counted('wrong')}" if factor in own else "" for factor in FACTORS]
        better = [f"x {factor:g} is better" for factor, one in own.items() if one.better(level)]
        yield row.format(" | ".join((constant.name, f"{constant.value:g}", *cells, ", ".join(better) or "none is better")))


def main() -> None:
    """Ask one question and print its table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("question", choices=sorted(QUESTIONS))
    parser.add_argument("--trials", type=int, default=20, help="draws; each gives a record of every kind")
    parser.add_argument("--seed", type=int, nargs="+", default=[1], help="one or more, taken together")
    parser.add_argument("--only", nargs="+", metavar="NAME", help="only these constants")
    parser.add_argument("--samples", type=int, default=1001)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--markdown", action="store_true", help="print a table in Markdown")
    options = parser.parse_args()
    question = QUESTIONS[options.question]
    level = LEVEL / sum(len(values(constant)) for constant in question.constants)
    names = [constant.name for constant in question.constants]
    if unknown := set(options.only or ()) - set(names):
        raise SystemExit(f"--only: got {', '.join(sorted(unknown))}, expected some of {', '.join(names)}")
    some = replace(question, constants=tuple(one for one in question.constants if one.name in (options.only or names)))
    found = worths(some, options.trials, options.seed, options.samples, options.jobs)
    asked_of = f"records of {options.samples} samples, seed {' and '.join(map(str, options.seed))}"
    print("\n".join(table(some, found, level, asked_of, options.markdown)))


if __name__ == "__main__":
    main()
