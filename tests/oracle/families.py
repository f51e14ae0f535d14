"""Systems with names: small ones with few nonzero entries at which statements about all systems tend to fail.

adversarial(field)     name -> SYSTEM, over any field (the entries are integers)
shift_register(n)      n states in a row, the fault enters the last and is an output, the first is the other output
delay_line(n)          n states in a row, the fault enters the last, the first is the only output
paper_example()        the example of the paper, over the cubic number field of its F
"""

from __future__ import annotations

from .fields import Json

Q: Json = "Q"
CUBIC: Json = {"minimal_polynomial": ["1", "-3", "-1", "4"]}
SQRT2: Json = {"minimal_polynomial": ["-2", "0", "1"]}
FIELDS: dict[str, Json] = {
    "Q": Q,
    "GF(2)": {"prime": 2},
    "GF(3)": {"prime": 3},
    "GF(5)": {"prime": 5},
    "Q(sqrt 2)": SQRT2,
    "Q(cubic)": CUBIC,
}

Rows = list[list[int]]


def system(field: Json, a: Rows, f: Rows, c: Rows, g: Rows, *, n: int, p: int, m: int) -> Json:
    """The result is the SYSTEM with these integers for entries."""
    return {"A": a, "F": f, "C": c, "G": g, "n": n, "m": m, "p": p, "field": field}


def shift_register(field: Json, n: int) -> Json:
    """For n >= 1 the delay is 0, since the fault is an output, but the lag is n."""
    return system(field, _shift(n), _last(n), [_first(n), [0] * n], [[0], [1]], n=n, p=2, m=1)


def delay_line(field: Json, n: int) -> Json:
    """For n >= 1 there is one infinite zero of order n - 1, and a delay of n: that of the transfer function q^-n."""
    return system(field, _shift(n), _last(n), [_first(n)], [[0]], n=n, p=1, m=1)


def paper_example() -> Json:
    """n = 3, p = 2, m = 1; F = (1, a, a^2) is an eigenvector of A, 4 a^3 - a^2 - 3 a + 1 = 0."""
    a = ["0", "1", "0"]
    a_squared = ["0", "0", "1"]
    return {
        "A": [["0", "1", "0"], ["0", "0", "1"], ["-1/4", "3/4", "1/4"]],
        "F": [["1"], [a], [a_squared]],
        "C": [["1", "0", "0"], ["0", "1", "0"]],
        "G": [["0"], ["0"]],
        "field": CUBIC,
    }


def adversarial(field: Json) -> dict[str, Json]:
    """These are the named systems over that field. A name says what is odd about its system."""
    named = {f"shift-register-{n}": shift_register(field, n) for n in range(1, 5)}
    named |= {f"delay-line-{n}": delay_line(field, n) for n in range(1, 5)}

    def add(name: str, a: Rows, f: Rows, c: Rows, g: Rows, dimensions: tuple[int, int, int]) -> None:
        n, p, m = dimensions
        named[name] = system(field, a, f, c, g, n=n, p=p, m=m)

    # A = 0: the smallest states that matter for one sample and are gone.
    add("a0-fault-and-state-seen", [[0]], [[1]], [[1], [0]], [[0], [1]], (1, 2, 1))
    add("a0-fault-and-doubled-state-seen", [[0]], [[2]], [[1], [0]], [[0], [1]], (1, 2, 1))
    add("a0-infinite-zero", [[0]], [[1]], [[1]], [[0]], (1, 1, 1))
    add("a0-zero-at-the-origin", [[0]], [[0]], [[1]], [[1]], (1, 1, 1))
    add("a0-idle-state", [[0]], [[0]], [[0]], [[1]], (1, 1, 1))
    add("a0-all-zero", [[0]], [[0]], [[0]], [[0]], (1, 1, 1))
    add("a0-two-faults", [[0]], [[1, 0]], [[1], [0]], [[0, 0], [0, 1]], (1, 2, 2))
    # What hypotheses forbid.
    add("unobservable", [[1]], [[1]], [[0]], [[1]], (1, 1, 1))
    add("unobservable-in-part", [[1, 0], [1, 1]], [[1], [0]], [[1, 0]], [[0]], (2, 1, 1))
    add("uncontrollable", [[1, 0], [0, 0]], [[1], [0]], [[1, 1], [0, 1]], [[0], [0]], (2, 2, 1))
    add("no-fault-enters", [[0, 1], [1, 1]], [[0], [0]], [[1, 0]], [[0]], (2, 1, 1))
    add("not-left-invertible-same-column-twice", [[1]], [[1, 1]], [[1], [0]], [[0, 0], [1, 1]], (1, 2, 2))
    add("not-left-invertible-silent-loop", [[0, 1], [0, 0]], [[0, 1], [1, 0]], [[1, 0]], [[0, 0]], (2, 1, 2))
    add("no-feedthrough", [[0, 1], [1, 0]], [[1], [1]], [[1, 0], [0, 1]], [[0], [0]], (2, 2, 1))
    add("no-feedthrough-nilpotent", [[0, 1, 0], [0, 0, 1], [0, 0, 0]], [[0], [1], [0]], [[1, 0, 0]], [[0]], (3, 1, 1))
    add("same-output-twice", [[1]], [[1]], [[1], [1]], [[1], [1]], (1, 2, 1))
    # Shapes.
    add("square", [[0, 1], [0, 0]], [[1, 0], [0, 1]], [[1, 0], [0, 1]], [[0, 0], [0, 1]], (2, 2, 2))
    add("more-faults-than-outputs", [[1, 1], [0, 1]], [[1, 0, 1], [0, 1, 1]], [[1, 0]], [[0, 0, 1]], (2, 1, 3))
    add("more-faults-than-outputs-static", [], [], [], [[1, 1]], (0, 1, 2))
    add("no-fault", [[0, 1], [0, 0]], [[], []], [[1, 0]], [[]], (2, 1, 0))
    add("no-fault-unobservable", [[1, 0], [0, 1]], [[], []], [[1, 1]], [[]], (2, 1, 0))
    add("no-output", [[1]], [[1]], [], [], (1, 0, 1))
    add("no-state", [], [], [[], []], [[1], [1]], (0, 2, 1))
    add("no-state-zero", [], [], [[], []], [[0], [0]], (0, 2, 1))
    add("states-only", [[0, 1], [0, 0]], [[], []], [], [], (2, 0, 0))
    add("outputs-only", [], [], [[], []], [[], []], (0, 2, 0))
    add("faults-only", [], [], [], [], (0, 0, 2))
    add("nothing", [], [], [], [], (0, 0, 0))
    return named


def _shift(n: int) -> Rows:
    return [[int(j == i + 1) for j in range(n)] for i in range(n)]


def _last(n: int) -> Rows:
    return [[int(i == n - 1)] for i in range(n)]


def _first(n: int) -> list[int]:
    return [int(j == 0) for j in range(n)]
