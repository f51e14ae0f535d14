"""These are Hypothesis strategies for SYSTEMs of the format, small and often degenerate.

    field_descriptions()        FIELD: Q, GF(2), GF(3), GF(5), Q(sqrt 2), Q(a) of the paper's cubic
    entries(field)              ENTRY, biased to 0
    entrywise_systems(...)      every entry drawn on its own, so that examples shrink to few small entries
    generated_systems(...)      from `structured`, out of a seed: planted structure, nulled states, zero blocks,
    repetitions named_systems(...)          from `families`
    systems(...)                all of these
    system_pairs(...)           two SYSTEMs, same field, same number of outputs, often equivalent or nearly so
    planted_systems(...)        (SYSTEM, Structure)

The arguments: field=FIELD (default: any), largest=3 for each of n, p, m.
"""

from __future__ import annotations

from random import Random

from hypothesis import strategies as st

from .families import FIELDS, adversarial
from .fields import Json
from .structured import Structure, planted_system, random_pair, random_structure, random_system

SEEDS = st.integers(min_value=0, max_value=2**32 - 1)


def field_descriptions() -> st.SearchStrategy[Json]:
    """This draws FIELDs of the format."""
    return st.sampled_from(list(FIELDS.values()))


def entries(field: Json) -> st.SearchStrategy[Json]:
    """It draws ENTRYs over that FIELD, of which half are zero."""
    rational = st.builds(_fraction, st.integers(-3, 3), st.sampled_from([1, 1, 1, 2, 3]))
    if field == "Q":
        nonzero: st.SearchStrategy[Json] = rational
    elif "prime" in field:
        nonzero = st.integers(0, field["prime"] - 1).map(str)
    else:
        d = len(field["minimal_polynomial"]) - 1
        nonzero = st.one_of(rational, st.lists(st.one_of(st.just("0"), rational), min_size=d, max_size=d))
    return st.one_of(st.just("0"), nonzero)


@st.composite
def entrywise_systems(draw: st.DrawFn, field: Json = None, largest: int = 3) -> Json:
    """It draws SYSTEMs entry by entry, each of F, C, G possibly zero altogether."""
    field = draw(field_descriptions()) if field is None else field
    n, p, m = (draw(st.integers(0, largest)) for _ in range(3))
    entry = entries(field)

    def block(height: int, width: int) -> Json:
        source = draw(st.sampled_from([entry, entry, entry, st.just("0")]))
        return [[draw(source) for _ in range(width)] for _ in range(height)]

    blocks = {"A": block(n, n), "F": block(n, m), "C": block(p, n), "G": block(p, m)}
    return {**blocks, "n": n, "m": m, "p": p, "field": field}


@st.composite
def generated_systems(draw: st.DrawFn, field: Json = None, largest: int = 3) -> Json:
    """It draws SYSTEMs by `random_system`."""
    field = draw(field_descriptions()) if field is None else field
    n, p, m = (draw(st.integers(0, largest)) for _ in range(3))
    return random_system(Random(draw(SEEDS)), field, n, p, m)


@st.composite
def named_systems(draw: st.DrawFn, field: Json = None, largest: int = 3) -> Json:
    """These are the adversarial SYSTEMs with no dimension above `largest`."""
    field = draw(field_descriptions()) if field is None else field
    fitting = [s for s in adversarial(field).values() if max(s["n"], s["m"], s["p"]) <= largest]
    return draw(st.sampled_from(fitting))


def systems(field: Json = None, largest: int = 3) -> st.SearchStrategy[Json]:
    """It draws SYSTEMs of all sorts."""
    return st.one_of(
        entrywise_systems(field=field, largest=largest),
        generated_systems(field=field, largest=largest),
        named_systems(field=field, largest=largest),
    )


@st.composite
def system_pairs(draw: st.DrawFn, field: Json = None, largest: int = 3) -> tuple[Json, Json]:
    """It draws pairs of SYSTEMs by `random_pair`."""
    field = draw(field_descriptions()) if field is None else field
    n, p, m = (draw(st.integers(0, largest)) for _ in range(3))
    return random_pair(Random(draw(SEEDS)), field, n, p, m)


@st.composite
def planted_systems(draw: st.DrawFn, field: Json = None, largest: int = 3) -> tuple[Json, Structure]:
    """It draws SYSTEMs together with the structure that was planted in them."""
    field = draw(field_descriptions()) if field is None else field
    n, p, m = (draw(st.integers(0, largest)) for _ in range(3))
    rng = Random(draw(SEEDS))
    structure = random_structure(rng, n, p, m)
    return planted_system(rng, field, structure), structure


def _fraction(numerator: int, denominator: int) -> str:
    return str(numerator) if denominator == 1 else f"{numerator}/{denominator}"
