"""Files that ask the checker for more than it may take: deep, long, wide, empty, of large numbers, of large promises.

Flood      the name of such a file, its kind of certificate where it is one, and what makes its bytes
floods     all of them
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from functools import partial
from random import Random
from typing import Any, NamedTuple

from tests.proofs.examples import LEADING, NORMAL, RANKS, STABLE, Certificate

BYTES = 2 * 2**20
LARGE_PRIME = 2**64 - 59
BIG = "7" * 19_700
NO_RANKS: dict[str, Any] = {"normal_rank": 0, "left_minimal_indices": []}


class Flood(NamedTuple):
    """This is a file that is made when it is asked for: together they have some 400 MB."""

    name: str
    kind: str
    made: Callable[[], bytes]


def flood(name: str, made: Callable[..., bytes], *arguments: Any) -> Flood:
    """Return the file that `made` makes of the arguments, where that is `dumped`, a certificate of the first of them."""
    return Flood(name, arguments[0] if made is dumped else "", partial(made, *arguments))


def dumped(kind: str, statement: Any, witness: Any) -> bytes:
    """Return a certificate as a file."""
    return json.dumps({**RANKS, "kind": kind, "statement": statement, "witness": witness}, separators=(",", ":")).encode()


def system(n: int, m: int, p: int, entry: Callable[[int, int], object] = lambda i, j: (i * j + i) % 3, **more: Any) -> dict[str, Any]:
    """Return a SYSTEM of that size."""
    shapes = {"A": (n, n), "F": (n, m), "C": (p, n), "G": (p, m)}
    return {name: [[entry(i, j) for j in range(w)] for i in range(h)] for name, (h, w) in shapes.items()} | {"n": n, "m": m, "p": p} | more


def digits_of(rng: Random, count: int) -> str:
    """Return a number with so many digits."""
    return "1" + "".join(rng.choices("0123456789", k=count - 1))


def repeated(text: str, around: str = "[@]") -> bytes:
    """Return the text as often as it fits into a file."""
    before, after = around.split("@")
    return (before + (text * (BYTES // len(text)))[: BYTES - len(around)].rsplit(",", 1)[0] + after).encode()


def of_json() -> Iterator[Flood]:
    """Yield files that flood the reader of JSON, before there is a certificate."""
    certificate = '{"format":"faultspace-certificate/1","kind":"window-ranks","statement":{"system":SYSTEM},"witness":WITNESS}'
    for text in ("1,", "[],", "[0],", "{},", '{"":0},', '"ab",', "[[]],", "257,", '"\u20ac",', "[[[[0]]]],", '{"a":{"b":{}}},', "-0,"):
        yield flood(f"many {text}", repeated, text)
        yield flood(f"a witness of many {text}", repeated, text, certificate.replace("WITNESS", "[@]"))
        yield flood(f"a system of many {text}", repeated, text, certificate.replace("SYSTEM", "[@]").replace("WITNESS", "{}"))
    yield flood("many keys", lambda: ("{" + ",".join(f'"{i:x}":0' for i in range(BYTES // 9)) + "}").encode()[:BYTES])
    yield flood("deep", lambda: b"[" * BYTES)
    yield flood("deep and closed", lambda: b"[" * (BYTES // 2) + b"]" * (BYTES // 2))
    yield flood("deep objects", lambda: b'{"a":' * (BYTES // 5))
    yield flood("a long integer", lambda: b"[" + b"7" * (BYTES - 2) + b"]")
    yield flood("long integers", repeated, f"{BIG},")
    yield flood("an exponent", lambda: b"[1e999999999]")
    yield flood("a long fraction", lambda: b"[0." + b"7" * (BYTES - 9) + b"]")
    yield flood("a long string", lambda: b'["' + b"\\n" * (BYTES // 2 - 4) + b'"]')
    yield flood("wide characters", lambda: ("[" + '"\U0001f600",' * (BYTES // 8) + "0]").encode()[:BYTES])
    yield flood("more than may be", lambda: b"1," * BYTES)


def of_sizes() -> Iterator[Flood]:
    """Yield small files that promise large things."""
    claim: dict[str, Any]
    witness: dict[str, Any]
    form: dict[str, Any]
    null: dict[str, Any]
    kinds: list[tuple[str, dict[str, Any]]]
    for p, n, m in ((512, 0, 0), (0, 512, 0), (0, 0, 512), (256, 0, 256), (1, 0, 0), (0, 0, 0), (0, 1, 0), (0, 0, 1)):
        about = system(n, m, p, lambda i, j: 0)
        for window in (0, 600, 4096):
            for name in ("toeplitz", "window"):
                for rank in (0, 4096):
                    claim = {"matrix": name, "system": about, "window": window, "rank": rank}
                    yield flood(f"{name} {n} {m} {p} {window} {rank}", dumped, "matrix-rank", claim, {"prime": 101, "left_null": []})
            claim = {"first": about, "second": about, "window": window}
            yield flood(f"equality {n} {m} {p} {window}", dumped, "window-equality", claim, {"prime": 101, "kernel": []})
        for length in (5, 2048, 4096):
            for name in ("excitation", "residual-hankel"):
                for window in (0, length // 2, length):
                    claim = {"matrix": name, "system": about, "window": window, "rank": 0, "x0": [0] * n, "v": [[0] * m] * length}
                    yield flood(f"{name} {n} {m} {p} {window} {length}", dumped, "matrix-rank", claim, {"prime": 101, "left_null": []})
        for delay in (0, n, None):
            witness = {"inverse": [[]] * m} if delay is not None else {"word": {"x0": [0] * n, "v": [[1] * m] * (n + 1)}}
            claim = {"system": about, "initial_state": "known", "delay": delay}
            yield flood(f"delay {n} {m} {p} {delay}", dumped, "inversion-delay", claim, witness)
        for degree in (1, 16):
            over = {**about, "field": {"minimal_polynomial": [-2] + [0] * (degree - 1) + [1]}}
            kinds = [("left-invertible", {"prime": 7, "root": 3}), ("schur-stable", {})]
            for kind, witness in kinds:
                yield flood(f"{kind} {n} {m} {p} of degree {degree}", dumped, kind, {"system": over}, witness)
        form = {"diagonal": [[]] * (n + min(m, p)), "left": [[[]] * (n + p)] * (n + p), "left_inverse": [[[]] * (n + p)] * (n + p)}
        form |= {"right": [[[]] * (n + m)] * (n + m), "right_inverse": [[[]] * (n + m)] * (n + m)}
        yield flood(f"zeros {n} {m} {p}", dumped, "infinite-zeros", {"system": about, "infinite_zero_orders": []}, form)
        pair = {"first": about, "second": about}
        minors = [{"point": 0, "rows": list(range(n + m))}] * 400 if m <= p else []
        yield flood(f"line {n} {m} {p}", dumped, "left-invertible-line", pair, {"prime": LARGE_PRIME, "minors": minors})
        yield flood(f"ranks {n} {m} {p}", dumped, "window-ranks", {"system": about, **NO_RANKS}, {"prime": 101, "kernel": []})
        null = {"state": [[0] * n] * 4096, "fault": [[0] * m] * 4096}
        yield flood(f"null {n} {m} {p}", dumped, "not-left-invertible", {"system": about}, null)
    rows = [{"pivot": i, "coefficients": [[]] * 4096} for i in range(60)]
    yield flood("rows of nothing", dumped, "window-ranks", {"system": system(0, 0, 0), **NO_RANKS}, {"prime": 101, "kernel": rows})
    poly = [[[0] * 4096] * 9] * 9
    form = {"diagonal": [[0]] * 9, "left": poly, "left_inverse": poly, "right": poly, "right_inverse": poly}
    claim = {"system": system(6, 3, 3), "normal_rank": 3, "invariant_zero_polynomial": [1]}
    yield flood("zeros by the thousand", dumped, "finite-zeros", claim, form)
    ones = [[[1] * 500] * 4] * 4
    form = {"diagonal": [[0]] * 4, "left": ones, "left_inverse": ones, "right": ones, "right_inverse": ones}
    yield flood("ones by the hundred", dumped, "finite-zeros", {**claim, "system": system(2, 2, 2)}, form)


def of_numbers() -> Iterator[Flood]:
    """Yield large and many numbers."""
    rng = Random(4)
    rank: dict[str, Any]
    shown: dict[str, Any]
    zeros: dict[str, Any]
    form_of: dict[str, Any]
    kinds: list[tuple[str, dict[str, Any], dict[str, Any]]]
    witness = {"prime": LARGE_PRIME, "kernel": []}
    for size, digits in ((2, 19_000), (4, 9_000), (6, 9_000), (10, 3_000), (40, 300), (80, 60), (150, 9)):
        for form in ("{0}", "{0}/{1}"):
            about = system(size, 1, 1, lambda i, j: form.format(digits_of(rng, digits), digits_of(rng, digits)))  # noqa: B023
            if len(json.dumps(about)) < BYTES:
                yield flood(f"{size} states of {digits} digits as {form}", dumped, "window-ranks", {"system": about, **NO_RANKS}, witness)
                yield flood(f"stability, {size} states of {digits} digits as {form}", dumped, "schur-stable", {"system": about}, {})
                rank = {"matrix": "observability", "system": about, "rank": size}
                shown = {"prime": LARGE_PRIME, "left_null": []}
                yield flood(f"rank, {size} states of {digits} digits as {form}", dumped, "matrix-rank", rank, shown)
                zeros = {"system": about, "normal_rank": 1, "invariant_zero_polynomial": [1]}
                unit = [[[int(i == j)] for j in range(size + 1)] for i in range(size + 1)]
                form_of = {"diagonal": [[1]] * (size + 1), "left": unit, "left_inverse": unit, "right": unit, "right_inverse": unit}
                yield flood(f"zeros, {size} states of {digits} digits as {form}", dumped, "finite-zeros", zeros, form_of)
    for n, m, p in ((330, 1, 1), (450, 30, 30), (100, 100, 300), (1, 255, 255), (255, 255, 1), (170, 170, 170)):
        for modulus in (101, LARGE_PRIME):
            about = system(n, m, p, lambda i, j: rng.randrange(10))
            kinds = [("left-invertible", {"system": about}, {"prime": modulus}), ("schur-stable", {"system": about}, {})]
            kinds += [("window-ranks", {"system": about, **NO_RANKS}, {"prime": modulus, "kernel": []})]
            for name in ("observability", "reachability"):
                kinds.append(("matrix-rank", {"matrix": name, "system": about, "rank": n}, {"prime": modulus, "left_null": []}))
            for kind, statement, shown in kinds:
                if len(content := dumped(kind, statement, shown)) < BYTES:
                    yield Flood(f"{kind} {n} {m} {p} modulo {modulus} {statement.get('matrix', '')}", kind, partial(bytes, content))
        finite = {**about, "field": {"prime": LARGE_PRIME}}
        yield flood(f"over a large field {n} {m} {p}", dumped, "left-invertible", {"system": finite}, {})
    for degree in (2, 16):
        for digits in (1, 19_000):
            f = ["3" * digits] * degree + ["7" * digits]
            for f_of in (f, [f"{a}/{b}" for a, b in zip(f, reversed(f), strict=True)]):
                about = system(2, 1, 1, lambda i, j: [f"{rng.randrange(100)}/7"] * degree, field={"minimal_polynomial": f_of})  # noqa: B023
                eisenstein = {"eisenstein": {"prime": 3, "shift": "7" * digits}}
                hows: tuple[dict[str, Any], ...] = ({}, {"irreducible": eisenstein}, {"irreducible": {"modulo": LARGE_PRIME}})
                for how in hows:
                    words = f"degree {degree} of {digits} digits {f_of is f} {how and [*how['irreducible']]}"
                    yield flood(f"{words}", dumped, "left-invertible", {"system": about}, {"prime": 101, "root": 3, **how})
                    yield flood(f"stability of {words}", dumped, "schur-stable", {"system": about}, how)
        for size in (20, 60, 100):
            root = {"minimal_polynomial": [-2] + [0] * (degree - 1) + [1]}
            about = system(size, 1, 1, lambda i, j: [rng.randrange(9)] * degree, field=root)  # noqa: B023
            if len(content := dumped("left-invertible", {"system": about}, {"prime": 7, "root": 3})) < BYTES:
                yield Flood(f"{size} states of degree {degree}", "left-invertible", partial(bytes, content))
                yield flood(f"stability of {size} states of degree {degree}", dumped, "schur-stable", {"system": about}, {})
    wild = [[f"{rng.randrange(10)}/{k + 512 * i + 1}" for k in range(400)] for i in range(400)]
    about = {"A": [], "F": [], "C": [[]] * 400, "G": [row[:100] for row in wild], "n": 0, "m": 100, "p": 400}
    yield flood("all denominators", dumped, "left-invertible", {"system": about}, {"prime": LARGE_PRIME})
    for m in (10, 12, 14, 16, 18, 200):
        first = {"A": [], "F": [], "C": [[]] * m, "G": [[rng.randrange(9) for _ in range(m)] for _ in range(m)], "n": 0, "m": m, "p": m}
        minors = [{"point": k, "rows": list(range(m))} for k in range(100)]
        yield flood(
            f"minors of {m}", dumped, "left-invertible-line", {"first": first, "second": first}, {"prime": LARGE_PRIME, "minors": minors}
        )


def of_experiments() -> Iterator[Flood]:
    """Long filters, windows, large numbers in them."""

    def changed(name: str, certificate: Certificate, key: str, value: Any, **more: Any) -> Flood:
        about = {**certificate["statement"]["experiment"], key: value, **more}
        return flood(name, dumped, certificate["kind"], {**certificate["statement"], "experiment": about}, certificate["witness"])

    for certificate in (LEADING, NORMAL):
        for lag in (100, 512):
            yield changed(f"{certificate['kind']} lag {lag}", certificate, "u_filter", [[[1]]] * lag)
            short = {"num": [[[1]]], "den": [1] + ["1/1000"] * (lag - 1)}
            yield changed(f"{certificate['kind']} denominators {lag}", certificate, "u_filter", short)
            large = {"num": [[[1]]], "den": [1] + [f"{k}/{10**300 + 7**k}" for k in range(lag - 1)]}
            yield changed(f"{certificate['kind']} long denominators {lag}", certificate, "u_filter", large)
            unit = [[int(i == j) for j in range(100)] for i in range(100)]
            width = {"B": [[1] * 100], "D": [[0] * 100], "u_filter": [unit] * min(lag, 60)}
            yield changed(f"{certificate['kind']} hundred inputs, lag {lag}", certificate, "v_filter", [[[1] * 100]], **width)
        for size in (100, 600, 4096):
            yield changed(f"{certificate['kind']} window {size}", certificate, "s", size)
            yield changed(f"{certificate['kind']} past {size}", certificate, "past", size)
            yield changed(f"{certificate['kind']} empty window {size}", certificate, "s", size, past=size, p=0, C=[], D=[], G=[])
    small = system(3, 0, 0, lambda i, j: "1/" + "9" * (5000 + i + j))
    yield flood("stable by far", dumped, "schur-stable", {"system": small}, STABLE["witness"])


def of_kernel_rows() -> Iterator[Flood]:
    """Yield long kernel rows of large systems, for the kinds whose statement rests on them; those of silent outputs are true."""
    rng = Random(6)
    for n, m, p in ((170, 170, 170), (1, 255, 255), (500, 0, 10), (30, 30, 60), (0, 0, 0)):
        width = n + p
        silent = {**system(n, m, p, lambda i, j: rng.randrange(10**6)), "C": [[0] * n] * p, "G": [[0] * m] * p}
        loud = system(n, m, p, lambda i, j: rng.randrange(10**6))
        units: list[dict[str, Any]] = [{"pivot": i, "coefficients": [[int(i == j) for j in range(p)]]} for i in range(p)]
        rows = max(1, min(p, BYTES // (200 * (p + 1))))
        long: list[dict[str, Any]] = [
            {"pivot": i, "coefficients": [[1] * p] * min(4096, BYTES // (4 * rows * (p + 1)))} for i in range(rows)
        ]
        for about, kernel in ((silent, units), (loud, units), (loud, long)):
            witness = {"prime": LARGE_PRIME, "kernel": kernel}
            name = f"{n} {m} {p} {'silent' if about is silent else 'loud'} {'units' if kernel is units else 'long'}"
            for window in (None, 4096):
                basis = [[int(i == j) for j in range(width)] for i in range(n)]
                yield flood(
                    f"fault space {name} {window}", dumped, "fault-space", {"system": about, "window": window, "basis": basis}, witness
                )
            column = {"system": about, "window": 4096, "column": [1] * width}
            yield flood(f"first column {name}", dumped, "first-column-only", column, witness)
            yield flood(f"inclusion {name}", dumped, "behaviour-inclusion", {"inner": about, "outer": about}, witness)
            yield flood(f"equal {name}", dumped, "behaviour-equality", {"first": about, "second": about}, witness)
            hints = {**witness, "point": 12345}
            for more in (hints, {**hints, "mix": 678910}, {**hints, "point": "infinity"}):
                words = f"equal by hints {name}, {more['point']}{', mix' if 'mix' in more else ''}"
                yield flood(words, dumped, "behaviour-equality", {"first": about, "second": about}, more)
            ranks = {
                "system": about,
                "normal_rank": p - len(kernel),
                "left_minimal_indices": [len(row["coefficients"]) - 1 for row in kernel],
            }
            yield flood(f"ranks by hints {name}", dumped, "window-ranks", ranks, hints)
            modulo = {key: value for key, value in hints.items() if key != "kernel"} | {"kernel_modulo": kernel}
            yield flood(f"ranks modulo {name}", dumped, "window-ranks", ranks, modulo)
            vectors = [[10**40 + i - j for j in range(n)] for i in range(min(n, BYTES // (200 * (n + m + 1))))]
            nulling = {"states": vectors, "faults": [[10**40] * m for _ in vectors], "motion": [[10**40] * len(vectors) for _ in vectors]}
            yield flood(f"ranks by nulling {name}", dumped, "window-ranks", ranks, {**modulo, "nulling": nulling})
        for length in (1, 400, 4096):
            if length * (m + p) * 2 < BYTES:
                word = {"x0": [9] * n, "v": [[9] * m] * length, "row": [[9] * p] * length}
                claim = {"first": loud, "second": silent, "window": length}
                yield flood(f"difference {n} {m} {p} {length}", dumped, "behaviour-difference", claim, word)


def floods() -> Iterator[Flood]:
    """Yield all of them, one after the other."""
    for part in (of_json, of_sizes, of_numbers, of_experiments, of_kernel_rows):
        yield from part()
