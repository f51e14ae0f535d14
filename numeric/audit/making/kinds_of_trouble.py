"""The kinds of trouble, one generator each: what makes ranks, zeros, models and fault spaces hard to find, or a program careless.

Each generator takes a source of random numbers and gives a system; `drawn` tries again, with numbers that follow from the seed and the
attempt alone, until the conditions hold that the question needs. Those are decided exactly, so that every machine draws the same systems.

    Kind      its slug, what is hard about it, the generator, the functions that it concerns, and how its fault moves
    KINDS     all of them
    STRUCTURE, MODEL, RANKS, COUNT, SPACE, SIGNAL    what may be asked
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from random import Random

from faultspace.exact.algebra.matrices import Matrix, stacked
from faultspace.exact.algebra.matrices import beside as columns_beside
from faultspace.exact.system.systems import ResidualSystem

from ..vectors.rationals import fractions, matrix
from .planting import (
    HALVES,
    SMALL,
    about_a_mean,
    beside,
    channel,
    delay,
    digits,
    drawn_dyadic,
    factor,
    hidden,
    in_unlike_units,
    late,
    pair,
    resized,
    series,
    spiked,
    tall,
    tall_without_zeros,
    times,
)

STRUCTURE, MODEL, RESIDUAL = "structure", "identify", "residual"
RANKS, COUNT, SPACE, SIGNAL = "window_ranks", "fault_dimension", "fault_space", "reconstruct"
FAULTS = (STRUCTURE, RESIDUAL, RANKS, COUNT, SPACE, SIGNAL)
RECORDS = (RESIDUAL, RANKS, COUNT, SPACE, SIGNAL)
ALL = (*FAULTS, MODEL)
Polynomial = list[Fraction]
Generator = Callable[[Random], ResidualSystem]


@dataclass(frozen=True)
class Kind:
    """A kind of trouble: `what` is hard, in words; `drawn` makes a system; `asks` names the functions that it concerns; `moves` gives the
    fault signal of the record, or the inputs, for a number of samples that suffices, and of faults or inputs."""

    slug: str
    what: str
    drawn: Generator
    asks: tuple[str, ...] = ALL
    moves: Callable[[Random, int, int], Matrix] = digits


# -- zeros ------------------------------------------------------------------------------------------------------------------------------


def _stable(rng: Random, degree: int) -> Polynomial:
    """Return a polynomial with different roots, of modulus 3/4 at the most, a pair among them where the degree is above two."""
    if degree > 2:
        return times(pair(Fraction(rng.choice((-1, 1)), 4), Fraction(1, 2)), *(factor(a) for a in rng.sample(HALVES, degree - 2)))
    return times(*(factor(a) for a in rng.sample(HALVES, degree)))


def _with_zeros(*numerators: Callable[[Random], Polynomial], excess: int = 0, n: int = 2, p: int = 3) -> Generator:
    """The generator of p outputs that see a channel for each numerator through a tall system of n states without zeros."""

    def generate(rng: Random) -> ResidualSystem:
        zeros = [numerator(rng) for numerator in numerators]
        bank = beside(*(channel(zero, _stable(rng, len(zero) - 1 + excess)) for zero in zeros))
        return hidden(rng, series(bank, tall_without_zeros(rng, n, len(zeros), p)))

    return generate


def _quarter(rng: Random) -> Fraction:
    return Fraction(rng.choice((-3, -2, -1, 1, 2, 3)), 4)


def _quarter_factor(rng: Random) -> Polynomial:
    return factor(_quarter(rng))


def _complex(rng: Random) -> Polynomial:
    """A pair and a real zero beside it: one number of three missing is no pair missing."""
    return times(pair(Fraction(rng.choice((-1, 1)), 2), Fraction(rng.choice((1, 2)), 4)), factor(_quarter(rng)))


def _always(polynomial: Polynomial) -> Callable[[Random], Polynomial]:
    return lambda rng: polynomial


def _twice(rng: Random) -> Polynomial:
    a = _quarter(rng)
    return times(factor(a), factor(a))


AT_0, AT_1, EIGHTH = (_always(factor(one)) for one in (0, 1, Fraction(1, 8)))


def _without_zeros(rng: Random) -> ResidualSystem:
    return hidden(rng, tall_without_zeros(rng, 4, 2, 4))


def _same_in_two_channels(rng: Random) -> ResidualSystem:
    a = _quarter(rng)
    bank = beside(*(channel(factor(a), _stable(rng, 1)) for _ in range(2)))
    return hidden(rng, series(bank, tall_without_zeros(rng, 2, 2, 4)))


def _on_the_circle(rng: Random) -> Polynomial:
    """One of i, -i; the sixth and the third roots of one."""
    return [Fraction(1), Fraction(rng.choice((-1, 0, 1))), Fraction(1)]


def _large(rng: Random) -> Polynomial:
    return times(factor(rng.choice((-1, 1)) * 2 ** rng.randint(8, 11)), factor(_quarter(rng)))


def _outside(rng: Random) -> Polynomial:
    return factor(rng.choice((-1, 1)) * Fraction(rng.choice((3, 4, 5)), 2))


def _uncontrollable(rng: Random) -> ResidualSystem:
    """Two states that move by themselves enter where the fault does, so that a fault can hide them: input decoupling zeros."""
    own = channel([Fraction(1)], times(factor(Fraction(1, 2)), factor(Fraction(-3, 4))))
    bank = channel(_quarter_factor(rng), _stable(rng, 1))
    behind = series(bank, tall_without_zeros(rng, 2, 1, 3))
    A = columns_beside(stacked(own.A, behind.F @ own.C), stacked(Matrix.zero(own.field, own.n, behind.n), behind.A))
    F = stacked(Matrix.zero(own.field, own.n, 1), behind.F)
    return hidden(rng, ResidualSystem(A, F, columns_beside(behind.G @ own.C, behind.C), behind.G))


def _unobservable(rng: Random) -> ResidualSystem:
    """A state that no output shows: an output decoupling zero."""
    seen = series(channel(_quarter_factor(rng), _stable(rng, 1)), tall_without_zeros(rng, 2, 1, 3))
    unseen = ResidualSystem(matrix([[_quarter(rng)]], 1), matrix([[1]], 1), Matrix.zero(seen.field, 0, 1), Matrix.zero(seen.field, 0, 1))
    both = beside(seen, unseen)
    return hidden(rng, ResidualSystem(both.A, stacked(seen.F, unseen.F), both.C, seen.G))


def _square_of(*numerators: Callable[[Random], Polynomial]) -> Generator:
    """The generator of the same channels without a tall system behind them: as many outputs as faults, mixed."""

    def generate(rng: Random) -> ResidualSystem:
        zeros = [numerator(rng) for numerator in numerators]
        bank = beside(*(channel(zero, _stable(rng, len(zero) - 1)) for zero in zeros))
        m = len(zeros)
        mixed = matrix([[int(i == j) + int(i == j + 1) for j in range(m)] for i in range(m)], m)
        return hidden(rng, ResidualSystem(bank.A, bank.F, mixed @ bank.C, mixed @ bank.G))

    return generate


def _deficient(rng: Random) -> ResidualSystem:
    """The same fault twice, with a zero at 0, where the rank is none."""
    single = series(channel(factor(0), _stable(rng, 1)), tall_without_zeros(rng, 2, 1, 3))
    return hidden(rng, single.with_faults(*(columns_beside(M, M) for M in (single.F, single.G))))


# -- poles ------------------------------------------------------------------------------------------------------------------------------


def _with_poles(*denominators: Polynomial | Callable[[Random], Polynomial], n: int = 2, p: int = 3) -> Generator:
    """The generator with a channel for each denominator, whose numerator is of the same degree and has zeros well inside."""

    def generate(rng: Random) -> ResidualSystem:
        polynomials = [one(rng) if callable(one) else one for one in denominators]
        bank = beside(*(channel(times(*(factor(a) for a in rng.sample(INSIDE, len(d) - 1))), d) for d in polynomials))
        return hidden(rng, series(bank, tall_without_zeros(rng, n, len(polynomials), p)))

    return generate


NEAR = Fraction(1, 2**12)
INSIDE = (Fraction(3, 8), Fraction(-3, 8), Fraction(1, 8), Fraction(-1, 8), Fraction(5, 8), Fraction(-5, 8))


def _nearly_unobservable(rng: Random) -> ResidualSystem:
    """A state that the outputs show 4096 times less than the others."""
    system = tall_without_zeros(rng, 4, 1, 3)
    C = [[x / 4096 if j == 0 else x for j, x in enumerate(row)] for row in fractions(system.C)]
    return ResidualSystem(system.A, system.F, matrix(C, 4), system.G)


# -- sizes ------------------------------------------------------------------------------------------------------------------------------


def _plain(n: int, m: int, p: int) -> Generator:
    return lambda rng: hidden(rng, tall(rng, n, m, p))


def _pure_noise(rng: Random) -> ResidualSystem:
    order = rng.sample(range(3), 3)
    G = matrix([[int(j == order[i]) for j in range(3)] for i in range(3)], 3)
    A, F, C = (Matrix.zero(G.field, *shape) for shape in ((0, 0), (0, 3), (3, 0)))
    return ResidualSystem(A, F, C, G)


def _direct(size: Fraction) -> Generator:
    """The first column of G is of this size."""

    def generate(rng: Random) -> ResidualSystem:
        system = tall(rng, 3, 2, 3)
        return system.with_faults(system.F, matrix([[x * size, *others] for x, *others in fractions(system.G)], system.m))

    return generate


def _delays(*samples: int) -> Generator:
    """Each fault comes so many samples late."""
    bank, m = beside(*(delay(one) for one in samples)), len(samples)
    return lambda rng: hidden(rng, series(bank, tall_without_zeros(rng, 2, m, m + 1)))


def _chains(*lengths: int) -> Generator:
    """An output for each chain of states, which hand on what comes from the last to the first: long observability indices.

    One fault acts on the last state of each chain, and reaches the first output directly."""

    def generate(rng: Random) -> ResidualSystem:
        bank = beside(*(channel([Fraction(1)], times(*(factor(rng.choice(HALVES)) for _ in range(one)))) for one in lengths))
        F = [[sum(row)] for row in fractions(bank.F)]
        G = [[Fraction(int(i == 0))] for i in range(len(lengths))]
        return ResidualSystem(bank.A, matrix(F, 1), bank.C, matrix(G, 1))

    return generate


def _nearly_parallel(rng: Random) -> ResidualSystem:
    """Two faults whose columns differ by 2^-16 of their size."""
    system = tall_without_zeros(rng, 3, 1, 4)
    off = drawn_dyadic(rng, 7, 1)
    near = stacked(system.F, system.G) + matrix([[x / 2**16 for x in row] for row in fractions(off)], 1)
    F, G = near.rows(range(3)), near.rows(range(3, 7))
    return system.with_faults(columns_beside(system.F, F), columns_beside(system.G, G))


def _whole_numbers(rng: Random) -> ResidualSystem:
    """Integers throughout and a nilpotent A: records of any length are small integers, which every type of number holds."""
    n, m, p = 3, 1, 3
    A = [[rng.choice((-1, 1)) if j > i else 0 for j in range(n)] for i in range(n)]
    F, C, G = ([[rng.choice((-2, -1, 1, 2)) for _ in range(b)] for _ in range(a)] for a, b in ((n, m), (p, n), (p, m)))
    return ResidualSystem(matrix(A, n), matrix(F, m), matrix(C, n), matrix(G, m))


def _nilpotent(rng: Random) -> ResidualSystem:
    A = [[Fraction(rng.choice((-1, 1))) if j > i else 0 for j in range(3)] for i in range(3)]
    return hidden(rng, ResidualSystem(matrix(A, 3), *(drawn_dyadic(rng, *shape) for shape in ((3, 1), (3, 3), (3, 1)))))


def _very_large(rng: Random) -> Polynomial:
    return times(factor(rng.choice((-1, 1)) * rng.randint(1001, 4096)), factor(_quarter(rng)))


def _five(rng: Random) -> Polynomial:
    """Five different zeros between -1 and 1."""
    return times(*(factor(Fraction(one, 8)) for one in rng.sample((-7, -5, -3, -2, -1, 1, 2, 3, 5, 7), 5)))


def _close(rng: Random) -> Polynomial:
    """Two real zeros, and a complex pair, 2^-12 from being double."""
    a = _quarter(rng)
    return times(factor(a), factor(a + NEAR), pair(-a / 2, NEAR))


def _orders_one_and_three(rng: Random) -> ResidualSystem:
    """Both faults are seen after one sample, and apart after three alone."""
    bank = beside(channel(_quarter_factor(rng), _stable(rng, 2)), channel([Fraction(1)], _stable(rng, 3)))
    mixed = matrix([[1, 1], [1, 2]], 2)
    return hidden(rng, ResidualSystem(bank.A, bank.F @ mixed, mixed @ bank.C, mixed @ bank.G))


def _resized(drawn: Generator, faults: Sequence[int], outputs: Sequence[int]) -> Generator:
    """The generator of the same systems in other units: fault j 2^faults[j] times as large, output i 2^outputs[i] times."""
    return lambda rng: resized(drawn(rng), [Fraction(2) ** one for one in faults], [Fraction(2) ** one for one in outputs])


def _silent_mode(rng: Random) -> ResidualSystem:
    """No fault acts, and no output shows one of the two states: its eigenvalue is a zero, and the rank is none."""
    shown, unseen = rng.sample(HALVES, 2)
    A, C = matrix([[shown, 0], [0, unseen]], 2), matrix([[1, 0], [rng.choice((-2, 2)), 0]], 2)
    return hidden(rng, ResidualSystem(A, matrix([[0], [0]], 1), C, matrix([[0], [0]], 1)))


def _adding_up(rng: Random) -> ResidualSystem:
    """Whole numbers as `_whole_numbers`, with a first state that adds up what the others hand on, and what the fault does to it."""
    system = _whole_numbers(rng)
    A = [[int(i == j == 0) + x for j, x in enumerate(row)] for i, row in enumerate(fractions(system.A))]
    return ResidualSystem(matrix(A, system.n), system.F, system.C, system.G)


KINDS = (
    Kind("zeros-none", "no zero at all: the fault space has one dimension a fault", _without_zeros),
    Kind("zeros-complex", "a complex pair and a real zero: none of the pair may be missing", _with_zeros(_complex)),
    Kind("zeros-repeated", "a zero of two channels' product: one chain of length two", _with_zeros(_twice)),
    Kind("zeros-repeated-apart", "the same zero in two channels: two chains of length one", _same_in_two_channels),
    Kind("zeros-at-0", "zeros at 0, where z itself is no shift", _with_zeros(AT_0)),
    Kind("zeros-at-1", "zeros at 1, where constants vanish", _with_zeros(AT_1)),
    Kind("zeros-on-the-circle", "a complex pair of modulus one", _with_zeros(_on_the_circle)),
    Kind("zeros-outside", "a zero outside the unit circle", _with_zeros(_outside)),
    Kind("zeros-large", "a zero of hundreds or thousands beside one below one", _with_zeros(_large)),
    Kind("zeros-uncontrollable", "zeros at uncontrollable modes", _uncontrollable, FAULTS),
    Kind("zeros-unobservable", "zeros at unobservable modes", _unobservable, (STRUCTURE, RANKS, COUNT, SPACE)),
    Kind("zeros-at-infinity", "a fault that shows a sample late beside a finite zero", _with_zeros(_complex, excess=1)),
    Kind("square-complex", "complex zeros, as many outputs as faults", _square_of(_complex, _outside), (STRUCTURE,)),
    Kind("square-repeated", "repeated zeros, as many outputs as faults", _square_of(_twice, EIGHTH), (STRUCTURE,)),
    Kind("rank-drops-at-0", "the rank of the pencil drops at 0 and nowhere else", _square_of(AT_0, AT_0), (STRUCTURE,)),
    Kind("rank-drops-at-1", "the rank of the pencil drops at 1 and nowhere else", _square_of(AT_1, _always(times())), (STRUCTURE,)),
    Kind("rank-drops-at-0-and-1", "the rank of the pencil drops at 0 and at 1", _with_zeros(AT_0, AT_1, p=4)),
    Kind("rank-deficient", "one fault twice, with a zero at 0: a rank seen at 0 is not the normal one", _deficient, (STRUCTURE,)),
    Kind("poles-unstable", "a pole outside the unit circle", _with_poles(factor(Fraction(17, 16)))),
    Kind("poles-unstable-pair", "a complex pair outside the unit circle", _with_poles(pair(Fraction(1, 2), Fraction(7, 8)))),
    Kind("poles-at-0", "a pole at 0", _with_poles(factor(0))),
    Kind("poles-at-1", "a pole at 1: a drift", _with_poles(factor(1))),
    Kind("poles-nilpotent", "a finite impulse response: A to the third power is zero", _nilpotent),
    Kind("poles-defective", "a double pole with one eigenvector", _with_poles(times(factor(Fraction(1, 2)), factor(Fraction(1, 2))), n=1)),
    Kind("poles-repeated", "a double pole with two eigenvectors", _with_poles(factor(Fraction(7, 8)), factor(Fraction(7, 8)), p=4)),
    Kind("poles-complex", "complex poles near the unit circle", _with_poles(pair(Fraction(1, 2), Fraction(3, 4)))),
    Kind("poles-nearly-unobservable", "a state that the outputs hardly show", _nearly_unobservable),
    Kind("order-12", "twelve states", _plain(12, 2, 6)),
    Kind("six-by-six", "six faults, six outputs", _plain(4, 6, 6), (STRUCTURE, RANKS, MODEL, RESIDUAL)),
    Kind("five-of-six", "five faults, six outputs", _plain(3, 5, 6)),
    Kind("square-D", "as many outputs as faults, D invertible", _plain(3, 2, 2), (STRUCTURE, RANKS, MODEL, RESIDUAL)),
    Kind("more-faults-than-outputs", "more faults than outputs", _plain(4, 4, 2), (STRUCTURE, RANKS)),
    Kind("small-D", "a column of D of a thousandth", _direct(Fraction(1, 2**10))),
    Kind("large-D", "a column of D of a thousand", _direct(Fraction(2**10))),
    Kind("no-fault", "nothing but the free response: no fault at all", _plain(3, 0, 3), (RANKS,)),
    Kind("no-fault-in-one-output", "the free response in a single output, whose windows have no full rank", _plain(2, 0, 1), (RANKS,)),
    Kind("pure-noise", "signs in every output: as many faults as outputs, or noise", _pure_noise, (RANKS,)),
    Kind("order-0", "no state", _plain(0, 2, 3), FAULTS),
    Kind("delays", "faults that show two and four samples late", _delays(2, 4)),
    Kind("long-lag", "eight states behind two outputs: a long window is due", _chains(7, 1), FAULTS),
    Kind("one-long-among-short", "one long index among short ones: the ranks seem to settle before they do", _chains(5, 1, 1)),
    Kind("nearly-parallel-faults", "two faults of nearly equal columns: an ill-conditioned fault space", _nearly_parallel, FAULTS),
    Kind("whole-numbers", "integers, which every type of number holds", _whole_numbers),
    Kind("whole-numbers-that-add-up", "integers and a state that forgets nothing, however long the record", _adding_up),
    Kind("zeros-beyond-a-thousand", "a zero of thousands, as little infinite as any number", _with_zeros(_very_large), (STRUCTURE,)),
    Kind("zeros-ten", "ten zeros", _with_zeros(_five, _five, p=4), (STRUCTURE,)),
    Kind("orders-one-and-three", "two faults that are seen at once, and told apart two samples later", _orders_one_and_three, (STRUCTURE,)),
    Kind(
        "small-units",
        "small F and C, and products of them smaller still",
        _resized(_square_of(_complex, EIGHTH), (-20, -20), (-20, -20)),
        (STRUCTURE,),
    ),
    Kind("silent-mode", "no fault, and a state that no output shows", _silent_mode, (STRUCTURE,)),
    Kind(
        "small-columns",
        "as many outputs as faults, of whose columns all are small",
        _resized(_square_of(_quarter_factor, EIGHTH), (-17, -17), (0, 0)),
        (STRUCTURE, RANKS, RESIDUAL, SIGNAL),
    ),
    Kind("order-1", "one state, one input, one output", _plain(1, 1, 1), (STRUCTURE, RANKS, MODEL, RESIDUAL)),
    Kind("fault-begins-late", "a fault that begins after two hundred samples", _plain(2, 2, 3), RECORDS, late),
    Kind("fault-with-a-spike", "a fault that is a thousand times larger in one sample", _plain(2, 1, 3), RECORDS, spiked),
    Kind("zeros-close", "zeros that are nearly double, and no more than nearly", _with_zeros(_close), (STRUCTURE,)),
    Kind(
        "faults-in-unlike-units",
        "a fault of a ten-millionth of another, which is its unit alone",
        _resized(_with_zeros(_quarter_factor, EIGHTH, p=4), (0, -24), (0, 0, 0, 0)),
        (STRUCTURE, SIGNAL),
    ),
    Kind(
        "outputs-in-unlike-units",
        "an output of a hundred-thousand-millionth of another, without which there is a zero",
        _resized(_plain(3, 1, 2), (0,), (0, -36)),
        (STRUCTURE,),
    ),
    Kind("inputs-about-a-mean", "inputs about a mean of many times their deviation", _plain(3, 2, 2), (MODEL,), about_a_mean),
    Kind(
        "inputs-in-unlike-units",
        "an input of a thousand-millionth of another, which does as much",
        _resized(_plain(3, 2, 3), (0, SMALL), (0, 0, 0)),
        (MODEL,),
        in_unlike_units,
    ),
    Kind(
        "poles-of-no-short-fraction",
        "poles that few digits do not write",
        _with_poles(times(factor(Fraction(1, 3)), factor(Fraction(2, 7))), n=1),
        (MODEL,),
    ),
)
