"""Scripts on records that are too long to stand in them, and are made there, in Python.

lines         how memory or time of a function grows
model_lines   whether a model of a long record is the one that made it
"""

from __future__ import annotations

from collections.abc import Sequence

from faultspace.exact.algebra.matrices import Matrix

from ...checks import growth
from ...records import Check
from ...signatures import ARGUMENTS
from ...vectors.rationals import floats


def lines(check: Check) -> list[str]:
    """Return the recipe of the records, the costs at two lengths, and the exponent beside its bound."""
    memory = check.slug == "memory-grows-with-N"
    short = dict(zip(ARGUMENTS[check.function], growth.question(check.function, 100), strict=True))
    rest = {"y": "record", "r": "record", "u": "signs", "F": "B", "G": "D", "x0": "np.zeros(len(A))"}
    given = ", ".join(
        str(short[name]) if name in ("order", "block_rows", "windows", "n_v") else rest.get(name, name)
        for name in ARGUMENTS[check.function]
    )
    cost = (
        [
            "    record, signs = driven(length)",
            "    tracemalloc.start()",
            f"    {check.function}({given})",
            "    most = tracemalloc.get_traced_memory()[1]  # bytes of numpy and Python alone",
            "    tracemalloc.stop()",
            "    return most",
        ]
        if memory
        else [
            "    record, signs = driven(length)",
            "    begun = time.process_time()",
            f"    {check.function}({given})",
            "    return time.process_time() - begun",
        ]
    )
    floor = growth.MEMORY_FLOOR if memory else growth.TIME_FLOOR
    return [
        "import time",
        "import tracemalloc",
        "from math import log",
        "",
        *_driven(growth.driven_system(check.function)),
        "",
        "",
        "def cost(length):",
        *cost,
        "",
        "",
        f"lengths = {growth.LENGTHS!r}",
        "costs = [cost(length) for length in lengths]",
        f"share = {floor!r} * lengths[0] / lengths[1]",
        f"exponent = log(costs[1] / max(costs[0], share)) / log(lengths[1] / lengths[0]) if costs[1] > {floor!r} else 0.0",
        f"failed = exponent > {growth.BOUND!r}",
        "print('WRONG' if failed else 'right', '- costs', costs, 'at lengths', lengths)",
        f"print(f'  exponent: got {{exponent:.2f}}, at most {growth.BOUND}')",
    ]


def model_lines(check: Check) -> list[str]:
    """Return the recipe of the record, the call, and the Markov parameters beside the whole numbers that they are."""
    kind = next(kind for kind, suffix in growth.KINDS.items() if check.vector == f"N{growth.LENGTHS[1]}{suffix}")
    *_, order, block_rows = growth.question("identify", 10, kind)
    return [
        "",
        *_driven(growth.driven_system("identify", kind)),
        "",
        "",
        "def markov(A, B, C, D):",
        "    return np.array([D] + [C @ np.linalg.matrix_power(A, k) @ B for k in range(2 * len(A) + 1)])",
        "",
        "",
        f"record, signs = driven({growth.LENGTHS[1]})",
        f"found = [np.asarray(one, dtype=float) for one in identify(record, signs, {order}, {block_rows})]",
        "off = np.abs(markov(*found) - markov(A, B, C, D)).max()",
        f"failed = not off <= {growth.NEAREST!r}",
        "print('WRONG' if failed else 'right', '- D, C B, C A B, ...')",
        f"print(f'  expected the whole numbers of the system, within {growth.NEAREST}; got what is off by {{off:.2g}}')",
    ]


def _driven(system: Sequence[Matrix]) -> list[str]:
    """Return the lines that define A, B, C, D and what makes a record of a length."""
    return [
        *(f"{name} = np.array({floats(one).tolist()!r})" for name, one in zip("ABCD", system, strict=True)),
        "",
        "",
        "def driven(length):",
        '    """The outputs and the inputs: signs of a linear congruential generator through the system, from rest."""',
        f"    state, drawn, x, out = {growth.SEED}, [], np.zeros(len(A)), []",
        "    for _ in range(length * B.shape[1]):",
        "        state = (6364136223846793005 * state + 1442695040888963407) % 2**64",
        "        drawn.append(1.0 if state >> 63 else -1.0)",
        "    signs = np.ascontiguousarray(np.array(drawn).reshape(B.shape[1], length).T)",
        "    for w in signs:",
        "        out.append(C @ x + D @ w)",
        "        x = A @ x + B @ w",
        "    return np.array(out), signs",
    ]
