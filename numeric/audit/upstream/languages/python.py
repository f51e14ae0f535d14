"""Scripts in Python with numpy alone.

Python   the dialect
"""

from __future__ import annotations

import base64
import zlib
from collections.abc import Sequence
from textwrap import wrap
from typing import Any

import numpy as np

from ..questions import LONGEST, Due
from .writing import floats, table

HELPERS = '''
failed = False


def told(what, got, expected, off, bound):
    """Print one comparison; `off` and `bound` are arrays of one shape or numbers."""
    global failed
    off, bound = (np.atleast_1d(np.asarray(one, dtype=float)) for one in (off, bound))
    wrong = bool(np.any(~(off <= bound)))
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.where(off == 0, 0.0, off / bound)
    failed = failed or wrong
    print(f"{what}: {'WRONG' if wrong else 'right'}")
    print("  got     ", np.array2string(np.asarray(got), threshold=40, prefix="  got      "))
    print("  expected", np.array2string(np.asarray(expected), threshold=40, prefix="  expected "))
    print(f"  off by {np.max(off, initial=0.0):.3g}, largest ratio to the bound {np.max(ratio, initial=0.0):.3g}")


def nearest(got, expected):
    """The numbers of `got` in the order of those of `expected` that they are nearest to; NaN where one is missing."""
    left, found = list(np.asarray(got, dtype=complex)), []
    for z in expected:
        found.append(left.pop(int(np.argmin(np.abs(np.array(left) - z)))) if left else np.nan)
    return np.array(found + ([np.nan] if left else []), dtype=complex)


def sine(got, expected):
    """The sine of the largest angle between the spaces of the columns, 1 where their dimensions differ."""
    spaces = []
    for columns in (got, expected):
        U, s, _ = np.linalg.svd(columns / (np.max(np.abs(columns), initial=0.0) or 1.0), full_matrices=False)
        spaces.append(U[:, s > 1e-12 * max(s, default=0.0)])
    P, Q = spaces
    return 1.0 if P.shape != Q.shape else np.linalg.norm(P - Q @ (Q.T @ P), 2)
'''.strip()
ENTRIES = ["told({what!r}, got, expected, np.abs(got - expected), bound)"]
GOT = {
    "markov": [
        "A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)",
        "got, powered = D, B",
        "while len(got) < len(expected):",
        "    got, powered = np.vstack([got, C @ powered]), A @ powered",
    ],
    "transfer": [
        "A, B, C, D = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)",
        "got = D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B)",
    ],
    "polynomial": ["got = np.poly(np.asarray(answer[0], dtype=float))[1:, None]"],
}
EQUAL = [
    "off = 0.0 if got.shape == expected.shape and np.array_equal(got, expected) else np.inf",
    "told({what!r}, got, expected, off, 0.0)",
]
PAIRS = [
    "got = nearest(got, expected.ravel())",
    "off = np.abs(got - expected.ravel()) if len(got) == expected.size else np.inf",
    "told({what!r}, got, expected.ravel(), off, bound.ravel() if np.ndim(off) else 0.0)",
]
COMPARED = {
    "markov": [*GOT["markov"], *ENTRIES],
    "transfer": [*GOT["transfer"], *ENTRIES],
    "polynomial": [*GOT["polynomial"], *ENTRIES],
    "eigenvalues": ["got = np.linalg.eigvals(np.asarray(answer[0], dtype=float))", *PAIRS],
    "residual": [
        "got = np.asarray(answer, dtype=float)",
        "off = got - expected",
        "seen = []  # what no initial state can cause, a number a kernel row",
        "for row in kernel_rows:",
        "    seen.append(np.linalg.norm(sum(off[k : len(off) - len(row) + 1 + k] @ row[k] for k in range(len(row)))))",
        "told({what!r}, got, expected, np.array(seen), bound.ravel())",
    ],
    "signal": [
        "got = np.asarray(answer, dtype=float)[: len(expected)]",
        "told({what!r}, got, expected, np.linalg.norm(got - expected), bound)",
    ],
    "space": ["got = np.asarray(answer, dtype=float)", "told({what!r}, got, expected, sine(got, expected), bound)"],
    "responses": [
        "A, C, Z = (np.asarray(part, dtype=float) for part in answer)",
        "f, got = Z[: len(A)], Z[len(A) :] / units",
        "while len(got) < len(expected):",
        "    f, got = A @ f, np.vstack([got, C @ f / units])",
        "told({what!r}, got, expected, sine(got, expected), bound)",
    ],
    "ranks": ["got = np.array(answer, dtype=float).reshape(-1, 1)", *EQUAL],
    "count": ["got = np.array([[answer]], dtype=float)", *EQUAL],
}
FIELD = "field = (lambda name: answer[name]) if isinstance(answer, dict) else (lambda name: getattr(answer, name))"
COMPARED |= {
    "finite_zeros": [FIELD, "got = field('finite_zeros')", *PAIRS],
    "infinite_zero_orders": [FIELD, "got = np.sort(np.array(field('infinite_zero_orders'), dtype=float)).reshape(-1, 1)", *EQUAL],
    "normal_rank": [FIELD, "got = np.array([[field('normal_rank')]], dtype=float)", *EQUAL],
    "left_invertible": [FIELD, "got = np.array([[bool(field('left_invertible'))]], dtype=float)", *EQUAL],
}


class Python:
    """The first lines of a script import numpy; what loads the function follows them."""

    def heading(self, words: Sequence[str]) -> list[str]:
        """Return the docstring and what the script uses."""
        return [
            '"""' + words[0],
            *words[1:],
            '"""',
            "",
            "import base64",
            "import sys",
            "import zlib",
            "",
            "import numpy as np",
            "",
            *HELPERS.splitlines(),
            "",
        ]

    def value(self, name: str, value: Any) -> list[str]:
        """Return the assignment."""
        if not isinstance(value, (list, np.ndarray)):
            return [f"{name} = {value!r}"]
        lines = self._plain(name, np.asarray(value, dtype=complex if np.iscomplexobj(value) else None))
        return [*lines, *_laid_out(name, value)] if isinstance(value, np.ndarray) else lines

    def _plain(self, name: str, array: Any) -> list[str]:
        if not array.size:
            return [f"{name} = np.zeros({array.shape!r})"]
        if len(array) > LONGEST:
            return [
                f"{name} = np.frombuffer(zlib.decompress(base64.b64decode(",
                *_bytes(array),
                f"))).reshape{array.shape!r}  # IEEE binary64, little-endian",
            ]
        if array.ndim == 1:
            return [f"{name} = np.array([{', '.join(map(_number, array))}])"]
        rows = ", ".join(f"[{', '.join(map(_number, row))}]" for row in array)
        return [f"{name} = np.array([", *wrap(rows, LINE_OF_ROWS, initial_indent="    ", subsequent_indent="    "), "])"]

    def asked(self, function: str, arguments: Sequence[str], *, refusal: bool) -> list[str]:
        """Return the call, and the end where there is no answer."""
        end = "sys.exit(0)  # right: there is nothing to answer" if refusal else "sys.exit('WRONG: an answer is due')"
        return [
            "try:",
            f"    answer = {function}({', '.join(arguments)})",
            "except (ValueError, ArithmeticError) as error:",
            '    print(f"refused: {type(error).__name__}: {error}")',
            "    answer = None",
            "if answer is None:",
            f"    {end}",
        ]

    def compared(self, due: Due) -> list[str]:
        """Return the comparison of one thing that is due."""
        sides = due.sides
        lines = []
        for name, value in sides.given.items():
            if name == "kernel_rows":
                lines += ["kernel_rows = []"]
                for row in value:
                    lines += [*self.value("row", floats(row)), "kernel_rows.append(row)"]
            elif name == "units":
                lines += self.value("units", np.array(table(floats(value))))
            else:
                lines += self.value(name, value)
        lines += self.value("expected", np.array(table(floats(sides.truth))))
        lines += self.value(
            "bound", np.array(table(floats(sides.bounds))) if isinstance(sides.bounds, (list, tuple)) else float(sides.bounds)
        )
        return [*lines, *(one.replace("{what!r}", repr(due.quantity)) for one in COMPARED[sides.of])]

    def twice(self, function: str, arguments: Sequence[str]) -> list[str]:
        """Return two calls and their comparison."""
        copies = ", ".join(f"np.copy({one})" if one not in SCALARS else one for one in arguments)
        return [
            f"first, second = (repr({function}({copies})) for _ in range(2))",
            "failed = first != second",
            "print('WRONG: two calls differ' if failed else 'right: two calls agree')",
            "print('  first ', first)",
            "print('  second', second)",
        ]

    def untouched(self, function: str, arguments: Sequence[str]) -> list[str]:
        """Return the call, and a look at the arguments after it."""
        kept = ", ".join(f"np.copy({one})" for one in arguments)
        given = ", ".join(arguments)
        return [
            f"kept = [{kept}]",
            f"{function}({given})",
            f"for name, before, after in zip({list(arguments)!r}, kept, [{given}]):",
            "    if not np.array_equal(before, after):",
            "        failed = True",
            "        print(f'WRONG: {name} was changed')",
            "        print('  before', before)",
            "        print('  after ', after)",
        ]

    def refused(self) -> list[str]:
        """Return what an answer means where a refusal is due."""
        return ["print('WRONG: answered where a refusal is due')", "print('  got', answer)", "failed = True"]

    def ending(self) -> list[str]:
        """Return the exit code."""
        return ["sys.exit(1 if failed else 0)"]


LINE_OF_ROWS = 130
LINE = 4000  # characters of a line of bytes
SCALARS = ("order", "block_rows", "windows", "n_v")


def _laid_out(name: str, value: Any) -> list[str]:
    """Return what gives an array the kind of numbers and the place in memory that it had where these are not the usual ones."""
    lines = [] if value.dtype in (np.dtype(float), np.dtype(complex), np.dtype(bool)) else [f"{name} = {name}.astype({str(value.dtype)!r})"]
    if value.size and not value.flags.c_contiguous:
        spread = f"np.repeat({name}, 2, axis=0)[::2]"
        lines.append(f"{name} = np.asfortranarray({name})" if value.flags.f_contiguous else f"{name} = {spread}  # every other row")
    return lines if value.flags.writeable else [*lines, f"{name}.setflags(write=False)"]


def _bytes(array: Any) -> list[str]:
    """Return the bytes of a long array as literals of text, a few thousand characters a line."""
    text = base64.b64encode(zlib.compress(np.ascontiguousarray(array, dtype="<f8").tobytes(), 9)).decode()
    return [f'    "{text[k : k + LINE]}"' for k in range(0, len(text), LINE)]


def _number(value: Any) -> str:
    text = repr(value.item() if hasattr(value, "item") else value)
    return text.replace("nan", "np.nan").replace("inf", "np.inf") if "n" in text else text
