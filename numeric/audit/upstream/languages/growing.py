"""A script that measures how memory or time of a function grows, in Python.

lines   the body of the script
"""

from __future__ import annotations

from ...checks import growth
from ...records import Check
from ...signatures import ARGUMENTS
from ...vectors.rationals import floats


def lines(check: Check) -> list[str]:
    """Return the recipe of the records, the costs at two lengths, and the exponent beside its bound."""
    memory = check.slug == "memory-grows-with-N"
    used = growth.driven_system(check.function)
    matrices = [f"{name} = np.array({floats(one).tolist()!r})" for name, one in zip("ABCD", used, strict=True)]
    short = dict(zip(ARGUMENTS[check.function], growth.question(check.function, 100), strict=True))
    rest = {"y": "record", "r": "record", "u": "signs", "F": "B", "G": "D", "x0": "np.zeros(len(A))"}
    given = ", ".join(
        str(short[name]) if name in ("order", "block_rows", "windows", "n_v") else rest.get(name, name)
        for name in ARGUMENTS[check.function]
    )
    cost = (
        [
            "    tracemalloc.start()",
            f"    {check.function}({given})",
            "    most = tracemalloc.get_traced_memory()[1]  # bytes of numpy and Python alone",
            "    tracemalloc.stop()",
            "    return most",
        ]
        if memory
        else ["    begun = time.process_time()", f"    {check.function}({given})", "    return time.process_time() - begun"]
    )
    floor = growth.MEMORY_FLOOR if memory else growth.TIME_FLOOR
    return [
        "import time",
        "import tracemalloc",
        "from math import log",
        "",
        *matrices,
        "",
        "",
        "def cost(length):",
        '    """Of a record of that length: signs of a linear congruential generator through the system, from rest."""',
        f"    state, drawn, x, out = {growth.SEED}, [], np.zeros(len(A)), []",
        "    for _ in range(length * B.shape[1]):",
        "        state = (6364136223846793005 * state + 1442695040888963407) % 2**64",
        "        drawn.append(1.0 if state >> 63 else -1.0)",
        "    signs = np.ascontiguousarray(np.array(drawn).reshape(B.shape[1], length).T)",
        "    for w in signs:",
        "        out.append(C @ x + D @ w)",
        "        x = A @ x + B @ w",
        "    record = np.array(out)",
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
