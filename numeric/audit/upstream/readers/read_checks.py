"""Put a Python file to the checks in FOLDER: python read_checks.py FOLDER MINE.py (needs numpy alone; growth is left out)."""
import importlib.util, json, pathlib, sys
import numpy as np
numbers = lambda x: np.array(x, dtype=float)  # "NaN", "Infinity" and "-Infinity" are strings in the files
complexes = lambda x: numbers(x).reshape(-1, 2) @ [1, 1j]
def pairs(got, true, bounds):
    """|got - true| / bound of the nearest pairs, narrow bounds first; infinite where one is left over."""
    got, worst = list(np.asarray(got, dtype=complex)), 0.0
    if len(got) != len(true): return np.inf
    for z, bound in sorted(zip(true, bounds), key=lambda pair: pair[1]):
        worst = max(worst, abs(got.pop(int(np.argmin(np.abs(np.array(got) - z)))) - z) / bound)
    return worst
def sine(got, true):
    """The sine of the largest angle between the spaces of the columns, 1 where their dimensions differ."""
    (P, p), (Q, q) = (np.linalg.svd(M / (np.max(np.abs(M), initial=0) or 1), full_matrices=False)[:2] for M in (got, true))
    P, Q = P[:, p > 1e-12 * max(p, default=0)], Q[:, q > 1e-12 * max(q, default=0)]
    return 1.0 if P.shape != Q.shape else np.linalg.norm(P - Q @ (Q.T @ P), 2)
def responses(A, C, Z, units, window):
    states, parts = Z[:len(A)], [Z[len(A):] / numbers(units)[:, None]]
    for _ in range(int(window) - 1): states, parts = A @ states, [*parts, C @ states / numbers(units)[:, None]]
    return np.vstack(parts)
def ratio(due, answer):
    """How far the answer is off, over what is allowed."""
    of, true, bounds, given = due["of"], due["floats"], due["bounds"], {name: one["floats"] for name, one in due["given"].items()}
    if of in ("markov", "transfer", "polynomial", "eigenvalues"):
        A, B, C, D = (np.atleast_2d(numbers(part)) for part in answer)
        if of == "eigenvalues": return pairs(np.linalg.eigvals(A), complexes(true), bounds)
        if of == "polynomial": got = np.poly(A)[1:]
        elif of == "transfer": got = (D + C @ np.linalg.solve(given["z"] * np.eye(len(A)) - A, B))[None]
        else: got = np.array([D, *(C @ np.linalg.matrix_power(A, k) @ B for k in range(len(true) - 1))])
        return np.max(np.abs(got - numbers(true)) / numbers(bounds), initial=0)
    if of == "residual":
        off, rows = numbers(answer) - numbers(true), map(numbers, given["kernel_rows"])
        return max((np.linalg.norm(sum(off[k:len(off) - len(c) + 1 + k] @ c[k] for k in range(len(c)))) / b for c, b in zip(rows, bounds)), default=0)
    if of == "signal": return np.linalg.norm(numbers(answer)[:len(true)] - numbers(true)) / bounds
    if of == "space": return sine(numbers(answer), numbers(true)) / bounds
    if of == "responses": return sine(responses(*map(numbers, answer), **given), numbers(true)) / bounds
    if of not in ("ranks", "count"): answer = answer[of] if isinstance(answer, dict) else getattr(answer, of)
    if of == "finite_zeros": return pairs(answer, complexes(true), bounds)
    return 0.0 if np.array_equal(np.sort(np.atleast_1d(answer)), np.sort(np.atleast_1d(true))) else np.inf

def passes(check, function):
    answers = []
    for call in check["calls"]:
        given = [numbers(one["floats"]).reshape(one["shape"]) if one["shape"] else one["floats"] for one in call["arguments"]]
        try: kept, answer = [np.copy(one) for one in given], function(*given)
        except (ValueError, ArithmeticError): answer = None
        if answer is None: return check["demand"] == "must-refuse" or check["may_refuse"]
        answers.append(answer)
        if check["manner"] == "inputs-untouched" and not all(map(np.array_equal, kept, given)): return False
        if not all(ratio(due, answer) <= 1 for due in call["expected"]): return False
    return check["demand"] != "must-refuse" and (check["manner"] != "deterministic" or repr(answers[0]) == repr(answers[1]))

if __name__ == "__main__":
    spec = importlib.util.spec_from_file_location("mine", sys.argv[2]); mine = importlib.util.module_from_spec(spec); spec.loader.exec_module(mine)
    checks = [json.loads(file.read_text("utf-8")) for file in sorted(pathlib.Path(sys.argv[1]).glob("checks/*.json"))]
    asked = [one for one in checks if hasattr(mine, one["asks"]) and one["demand"] != "free" and one["growth"] is None]
    failed = [one["name"] for one in asked if not passes(one, getattr(mine, one["asks"]))]
    print(*(f"failed: {name}" for name in failed), f"{len(asked)} checks, {len(failed)} failed", sep="\n")
    sys.exit(bool(failed))
