"""These are certificates to try the checker with, and ways to spoil them.

FIELDS, systems    small systems of every shape over Q, Q(a), Q(sqrt 2), GF(2), GF(3)
lines, stable      pairs and systems that the kinds left-invertible-line and schur-stable are about
experiments        what the kinds moesp-limit and input-limit are about, small
limit_certificates those of one experiment
forged_inputs      what output_error_inputs makes of B and D that are not the solution
certificates       certificates of every kind about them, as they come out of files
base, hinted       one certificate of a kind, without hints and with them; by_chain: one whose hints are taken away
spoiled            a copy of a certificate with something replaced or deleted
RANKS, ...         the certificates that the tests spoil
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

from faultspace.exact.algebra.fields import QQ, Field, NumberField, PrimeField
from faultspace.exact.algebra.matrices import Matrix
from faultspace.exact.limits.experiments import Experiment, read_experiment
from faultspace.exact.limits.inputs import InputLimit
from faultspace.exact.limits.moesp import limit
from faultspace.exact.structure.fault_columns import fault_space
from faultspace.exact.structure.kernel_rows import KernelRepresentation, kernel_representation
from faultspace.exact.system.systems import ResidualSystem
from faultspace.proofs.trust import structure_certificates as make
from faultspace.proofs.trust.kernel_witnesses import chain_witness
from faultspace.proofs.trust.limit_certificates import Certified

Certificate = dict[str, Any]
CUBIC = NumberField(("1", "-3", "-1", "4"))  # type: ignore[arg-type]
SQRT2 = NumberField(("-2", "0", "1"))  # type: ignore[arg-type]
FIELDS: dict[str, Field] = {"Q": QQ, "Q(a)": CUBIC, "Q(sqrt 2)": SQRT2, "GF(2)": PrimeField(2), "GF(3)": PrimeField(3)}
GONE = object()


def seen(field: Field = QQ, gain: object = 1) -> ResidualSystem:
    """Return x+ = gain v, r = (x, v): one relation, of degree 1."""
    return ResidualSystem.of([[0]], [[gain]], [[1], [0]], [[0], [1]], field=field)


def free(field: Field = QQ) -> ResidualSystem:
    """Return the same with a state that stays: r = (x, v), x+ = x + v. Its second sample gives it away."""
    return ResidualSystem.of([[1]], [[1]], [[1], [0]], [[0], [1]], field=field)


def lines(field: Field) -> Iterator[tuple[ResidualSystem, ResidualSystem]]:
    """Pairs that are left-invertible for every (a : b): one fault and two, as many outputs as faults and more, no states, no faults."""
    of = ResidualSystem.of
    yield seen(field), of([[0]], [[0]], [[1], [0]], [[1], [0]], field=field)
    yield of([[0]], [[1]], [[1]], [[0]], field=field), of([[0]], [[0]], [[1]], [[1]], field=field)
    if isinstance(field, NumberField):
        root = [0, 1, *[0] * (field.degree - 2)]
        yield of([[root]], [[1]], [[1], [0]], [["1/3"], [0]], field=field), of([[root]], [[root]], [[1], [0]], [[0], [1]], field=field)
    two = [[[1, 0], [0, 1], [0, 0]], [[0, 0], [1, 0], [0, 1]]]
    yield of([], [], [[]] * 3, two[0], field=field, n=0, m=2, p=3), of([], [], [[]] * 3, two[1], field=field, n=0, m=2, p=3)
    fed = [of([[1]], [[0, 1]], [[0], [0], [1]], gains, field=field) for gains in ([[1, 0], [0, 1], [0, 0]], [[0, 0], [1, 0], [0, 1]])]
    yield fed[0], fed[1]
    for n, m, p in ((1, 0, 1), (0, 0, 0)):
        bare = of([[1]][:n], [[]][:n], [[1]][:p], [[]][:p], field=field, n=n, m=m, p=p)
        yield bare, bare


def stable(field: Field) -> Iterator[ResidualSystem]:
    """Yield systems over Q or Q(a), with all eigenvalues inside the unit circle: none, nilpotent, complex, and a / 4."""
    for A in ([], [[0, 5], [0, 0]], [["1/2", "-1/2"], ["1/2", "1/2"]], [["-7/8"]]):
        n = len(A)
        yield ResidualSystem.of(A, [[]] * n, [], [], field=field, n=n, m=0, p=0)
    if isinstance(field, NumberField):
        quarter = [0, "1/4", *[0] * (field.degree - 2)]
        yield ResidualSystem.of([[0, quarter], [1, 0]], [[1], [0]], [[1, 0]], [[0]], field=field)


def experiment(**changes: Any) -> Experiment:
    """Return x+ = x / 2 + u + v, y = x + v / 2 with v(k) = u(k+1), and whatever is changed."""
    data = {"A": [["1/2"]], "B": [[1]], "C": [[1]], "D": [[0]], "F": [[1]], "G": [["1/2"]], "s": 2, "past": 1}
    return read_experiment(data | {"u_filter": [[[0]], [[1]]], "v_filter": [[[1]]]} | changes)


def experiments() -> dict[str, Experiment]:
    """With leads and lags, coloured u, noise, two inputs, no faults, no states, unseen states; without a solution that is only one."""
    nothing = {"n": 0, "m": 1, "p": 1, "nu": 1, "A": [], "B": [], "C": [[]], "F": []}
    still = {"n": 1, "m": 0, "p": 1, "nu": 1, "F": [[]], "G": [[]], "v_filter": [[]]}
    two = {"B": [[1, 0]], "D": [[0, "1/3"]], "u_filter": [[[1, 0], [0, 1]], [[0, 0], [1, 0]]], "v_filter": [[[0, 0]], [[1, "-1/2"]]]}
    return {
        "lead": experiment(),
        "lag": experiment(u_filter=[[["-2"]]], v_filter=[[[0]], [["2/3"]]]),
        "coloured": experiment(u_filter={"num": [[[1]]], "den": [1, "-1/2"]}, v_filter=[[[0]], [[1]]]),
        "noise": experiment(v_filter={"num": [[[1]], [["1/2"]]], "den": ["1", "1/3"]}, w_filter={"num": [[[2]]], "den": [1, "1/4"]}),
        "two inputs": experiment(**two),
        "no faults": experiment(**still),
        "no states": experiment(**nothing),
        "unseen": experiment(C=[[0]], s=1, past=1),
    }


def limit_certificates(about: Experiment) -> Iterator[Certificate]:
    """Yield the certificates by both instruments and both regressions, where these have one solution."""
    found = limit(about)
    yield Certified(found).past_input_limit()
    yield Certified(found).past_input_and_output_limit()
    if found.true_AC is not None:
        yield Certified(found).output_error_inputs()
    if found.moesp is not None:
        yield Certified(found).moesp_inputs()


def forged_inputs(about: Experiment, B: object, D: object) -> Certificate:
    """Return a certificate as if these B and D were what the true-AC regression gives."""
    found = limit(about)
    return written(Certified(replace(found, true_AC=InputLimit(Matrix.of(B), Matrix.of(D)))).output_error_inputs())


def systems(field: Field) -> Iterator[ResidualSystem]:
    """Small systems of every shape: with and without states, faults, outputs, relations, zeros, left inverse."""
    yield seen(field)
    yield ResidualSystem.of([[1]], [[1]], [[0]], [[1]], field=field)
    yield ResidualSystem.of([[0, 1], [0, 0]], [[0], [1]], [[1, 0]], [[0]], field=field)
    yield ResidualSystem.of([[1]], [[1, 1]], [[1], [0]], [[0, 0], [1, 1]], field=field)
    if isinstance(field, NumberField):
        d = field.degree
        yield ResidualSystem.of([[[0, 1, *[0] * (d - 2)]]], [["1/2"]], [[1], [[1] * d]], [["-1/3"], [0]], field=field)
    yield ResidualSystem.of([], [], [[], []], [[1], [1]], field=field, n=0, m=1, p=2)
    yield ResidualSystem.of([[1]], [[]], [[1]], [[]], field=field, n=1, m=0, p=1)
    yield ResidualSystem.of([[1]], [[1]], [], [], field=field, n=1, m=1, p=0)
    yield ResidualSystem.of([], [], [], [], field=field, n=0, m=0, p=0)


def written(certificate: Certificate) -> Certificate:
    """Return the certificate as it comes out of a file."""
    result: Certificate = json.loads(json.dumps(certificate))
    return result


def certificates(field: Field) -> Iterator[Certificate]:
    """Yield certificates of every kind, as they come out of files."""
    for system in systems(field):
        kernel = kernel_representation(system)
        x0 = Matrix.of([[1]] * system.n, field, shape=(system.n, 1))
        v = Matrix.of([[k * k % 3] * system.m for k in range(5)], field, shape=(5, system.m))
        found = [make.window_ranks(kernel), make.left_invertible(kernel), make.finite_zeros(system), make.infinite_zeros(system)]
        found += [make.inversion_delay(kernel, known_state=known) for known in (True, False)]
        found += [make.behaviour_equality(kernel, kernel), make.behaviour_inclusion(system, kernel)]
        found += [make.window_equality(kernel, kernel, window) for window in (0, 1, 3)]
        found += [make.fault_space(kernel, fault_space(kernel, window)) for window in (None, 0, 1, 2, 3)]
        found += [make.matrix_rank(name, system, window=3) for name in ("observability", "reachability", "toeplitz", "window")]
        found += [make.matrix_rank(name, system, window=0) for name in ("toeplitz", "window")]
        found += [make.data_rank(name, system, x0, v, s) for name in ("residual-hankel", "excitation") for s in (0, 2, 5)]
        yield from map(written, [*found, make.window_ranks_of(system)])
        yield from (by_chain(written(certificate), kernel) for certificate in found if "point" in certificate["witness"])
    kernel = kernel_representation(seen(field))
    yield written(make.behaviour_difference(free(field), kernel))
    yield written(make.first_column_only(kernel, 2, Matrix.of([[0], [1], [0]], field)))
    yield from (written(make.left_invertible_line(*pair)) for pair in lines(field))
    if not isinstance(field, PrimeField):
        yield from (written(make.schur_stable(system)) for system in stable(field))
    if field == QQ:
        yield from (written(certificate) for about in experiments().values() for certificate in limit_certificates(about))


def spoiled(certificate: Certificate, *changes: tuple[str, Any]) -> Certificate:
    """Return a copy with the values at dotted paths replaced (by what a function makes of them, if it is one), or deleted if GONE."""
    result = written(certificate)
    for path, value in changes:
        *parents, last = [int(key) if key.isdigit() else key for key in path.split(".")]
        node: Any = result
        for key in parents:
            node = node[key]
        if value is GONE:
            del node[last]
        else:
            node[last] = value(node[last]) if callable(value) else value
    return result


def base(kind: str, field: Field = QQ, system: ResidualSystem | None = None, **more: Any) -> Certificate:
    """Return the certificate of that kind that gets spoiled, about `seen` by default, without hints."""
    return by_chain(hinted(kind, field, system, **more), kernel_representation(system or seen(field)))


def by_chain(certificate: Certificate, kernel: KernelRepresentation) -> Certificate:
    """Return the certificate without hints, as all were once: where it has rows, those below its window."""
    if "point" not in certificate["witness"]:
        return certificate
    bare = chain_witness(kernel, certificate["statement"].get("window"))
    return written({**certificate, "witness": {key: bare[key] for key in bare if key != "kernel" or key in certificate["witness"]}})


def hinted(kind: str, field: Field = QQ, system: ResidualSystem | None = None, **more: Any) -> Certificate:
    """Return the certificate of that kind as it is made today."""
    system = system or seen(field)
    kernel = kernel_representation(system)
    makers: dict[str, Callable[[], Certificate]] = {
        "window-ranks": lambda: make.window_ranks(kernel),
        "generic": lambda: make.window_ranks_of(system),
        "left-invertible": lambda: make.left_invertible(kernel),
        "inversion-delay": lambda: make.inversion_delay(kernel, known_state=more["known"]),
        "behaviour-equality": lambda: make.behaviour_equality(kernel, kernel),
        "behaviour-inclusion": lambda: make.behaviour_inclusion(system, kernel),
        "window-equality": lambda: make.window_equality(kernel, kernel, 2),
        "behaviour-difference": lambda: make.behaviour_difference(free(field), kernel),
        "fault-space": lambda: make.fault_space(kernel, fault_space(kernel, more.get("window"))),
        "first-column-only": lambda: make.first_column_only(kernel, 2, Matrix.of([[0], [1], [0]], field)),
        "matrix-rank": lambda: make.matrix_rank(more.get("name", "window"), system, window=2),
        "excitation": lambda: make.data_rank("excitation", system, Matrix.of([[1]], field), Matrix.of([[1], [0], [1], [1]], field), 2),
        "left-invertible-line": lambda: make.left_invertible_line(*next(lines(field))),
        "schur-stable": lambda: make.schur_stable(system),
        "finite-zeros": lambda: make.finite_zeros(system),
        "infinite-zeros": lambda: make.infinite_zeros(system),
    }
    return written(makers[kind]())


LINE = ResidualSystem.of([[0, 1], [0, 0]], [[0], [1]], [[1, 0]], [[0]])  # delay 2, two samples of an ambiguous word
TWICE = ResidualSystem.of([[1]], [[1, 1]], [[1], [0]], [[0, 0], [1, 1]])  # not left-invertible
ZERO = ResidualSystem.of([[2]], [[1]], [[1]], [[1]])  # one finite zero, at 1
FLAT = ResidualSystem.of([], [], [[], []], [[0], [0]], n=0, m=1, p=2)  # two relations of degree 0
S = "statement.system"
K = "witness.kernel"
RANKS, CUBED, ROOTED = (base("window-ranks", field) for field in (QQ, CUBIC, SQRT2))
FLAT_RANKS = base("window-ranks", system=FLAT)
HINTED, GENERIC, INVERTIBLE = (hinted(kind) for kind in ("window-ranks", "generic", "left-invertible"))
DELAY, OPEN = (base("inversion-delay", known=known, system=LINE) for known in (True, False))
NULL, FINITE = base("left-invertible", system=TWICE), base("finite-zeros", system=ZERO)
SPACE, COLUMN = base("fault-space"), base("first-column-only")
WINDOW, DATA, SAME, EQUAL = base("matrix-rank"), base("excitation"), base("window-equality"), base("behaviour-equality")
DIFFERENCE = base("behaviour-difference")
PAIR, STABLE = base("left-invertible-line"), base("schur-stable")
LEADING, OUTPUTS, NORMAL, PROJECTED = (written(certificate) for certificate in limit_certificates(experiment()))
SEVEN_B, SEVEN_D = (forged_inputs(experiment(), B, D) for B, D in (([[7]], NORMAL["statement"]["D"]), (NORMAL["statement"]["B"], [[7]])))
EISENSTEIN = {"eisenstein": {"prime": 2, "shift": 0}}
HUGE = "9" * 20000
