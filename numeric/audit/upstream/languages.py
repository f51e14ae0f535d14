"""How a script that shows a check is written in Python with numpy, in Octave and MATLAB, which share a text, and in Julia.

Dialect     what a language has to say: numbers, calls, comparisons, ends
LANGUAGES   name -> its dialect
compared    the lines that compare one thing that is due;   side_by_side   of assignments
"""

from __future__ import annotations

import base64
import zlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from textwrap import wrap
from typing import Any

import numpy as np

from .questions import LONGEST, Due

WIDTH = 130  # of lines of numbers


@dataclass(frozen=True)
class Dialect:
    """Templates of lines. They know {function}, {given}, {copied} and {names} (its arguments), {answer} (what a call is assigned to),
    {refused} and {code} (what a refusal means, and the exit code), and {what} (a quantity). `assigned` gives the lines that set a variable
    to a number or an array, `compared` has the lines by what is compared, and a helper is written where its name is used."""

    mark: str
    opening: str
    assigned: Callable[[str, Any], list[str]]
    call: str
    compared: Mapping[str, str]
    helpers: Mapping[str, str]
    rows: tuple[str, str]  # begins the list of kernel rows, and adds one
    twice: str
    untouched: str
    answered: str
    ending: str
    answers: Mapping[str, str]
    copied: str = "{}"


def compared(dialect: Dialect, due: Due) -> list[str]:
    """Return the assignments of `expected`, `bound` and what the comparison needs besides, and the comparison."""
    sides, parts = due.sides, list[list[str]]()
    for name, value in sides.given.items():
        if name == "kernel_rows":
            begin, add = dialect.rows
            parts += [[begin], *(part for row in value for part in (dialect.assigned("row", np.array(_floats(row))), [add]))]
        else:
            parts.append(dialect.assigned(name, np.array(_floats(value)) if isinstance(value, list) else value))
    for name, value in (("expected", _floats(sides.truth)), ("bound", _floats(sides.bounds))):
        parts.append(dialect.assigned(name, np.array(value) if isinstance(value, list) else value))
    what = due.quantity.replace('"', "'")
    return [*side_by_side(parts), *dialect.compared[sides.of].replace("{what}", what).strip("\n").splitlines()]


def side_by_side(parts: Sequence[list[str]]) -> list[str]:
    """Return the lines of assignments, the short ones on one line where they fit."""
    lines, room = list[str](), False
    for part in parts:
        together = f"{lines[-1].rstrip(';')}; {part[0]}" if room else ""
        if len(part) == 1 and 0 < len(together) <= WIDTH:
            lines[-1] = together
        else:
            lines += part
        room = len(part) == 1
    return lines


def _floats(value: Any) -> Any:
    """Return nested lists with floats for Fractions; complex numbers and integers stay."""
    if isinstance(value, (list, tuple)):
        return [_floats(one) for one in value]
    return value if isinstance(value, (bool, int, complex)) else float(value)


# -- Python -------------------------------------------------------------------------------------------------------------------------------


def _in_python(name: str, value: Any) -> list[str]:
    if not isinstance(value, np.ndarray):
        return [f"{name} = {value!r}"]
    array = np.asarray(value, dtype=complex if np.iscomplexobj(value) else None)
    shape = f".reshape{array.shape!r}" if array.ndim > 1 else ""
    if not array.size:
        lines = [f"{name} = np.zeros({array.shape!r})"]
    elif len(array) > LONGEST:  # IEEE binary64, little-endian
        text = base64.b64encode(zlib.compress(np.ascontiguousarray(array, dtype="<f8").tobytes(), 9)).decode()
        rows = wrap(text, WIDTH, initial_indent='    "', subsequent_indent='    "')
        lines = ["import base64, zlib", f"{name} = np.frombuffer(zlib.decompress(base64.b64decode(", *(f'{one}"' for one in rows)]
        lines.append(f"))){shape}")
    else:
        numbers = ", ".join(map(_number_in_python, array.ravel().tolist()))
        short = f"{name} = np.array([{numbers}]){shape}"
        broken = wrap(numbers, WIDTH, initial_indent="    ", subsequent_indent="    ", break_long_words=False)
        lines = [short] if len(short) <= WIDTH else [f"{name} = np.array([", *broken, f"]){shape}"]
    # The kind of numbers and the place in memory, where these are not the usual ones.
    if value.dtype not in (np.dtype(float), np.dtype(complex), np.dtype(bool)):
        lines.append(f"{name} = {name}.astype({str(value.dtype)!r})")
    if value.size and not value.flags.c_contiguous:
        lines.append(f"{name} = np.asfortranarray({name})" if value.flags.f_contiguous else f"{name} = np.repeat({name}, 2, axis=0)[::2]")
    return lines if value.flags.writeable else [*lines, f"{name}.setflags(write=False)"]


def _number_in_python(value: Any) -> str:
    text = repr(value)
    return text.replace("nan", "np.nan").replace("inf", "np.inf") if "n" in text else text


_EQUAL = 'told("{what}", got, expected, 0.0 if list(np.ravel(got)) == list(np.ravel(expected)) else np.inf, 0.0)'
_ENTRIES = """# to the bound comes what comparing in floats adds
told("{what}", got, expected, np.abs(got - expected), bound + len(expected) * np.spacing(np.abs(expected).max()))"""
_PAIRS = """
got = nearest(got, expected)
told("{what}", got, expected, *((np.abs(got - expected), bound) if len(got) == len(expected) else (np.inf, 0.0)))"""
_SINE = 'told("{what}", got, expected, sine(got, expected), bound)'
_FIELD = "got = answer['{0}'] if isinstance(answer, dict) else answer.{0}\n"
MODEL = "A, B, C, D = (np.atleast_2d(np.asarray(one, dtype=float)) for one in answer)\n"
PYTHON = Dialect(
    mark="#",
    opening="""
from __future__ import annotations

import sys

import numpy as np

wrong = []
""",
    assigned=_in_python,
    call="""
try:
    answer = {function}({given})
except (ValueError, ArithmeticError) as error:
    answer = print("refused:", error)
if answer is None:
    print("{refused}")
    sys.exit({code})""",
    helpers={
        "told": """

def told(what, got, expected, off, bound):
    wrong.append(not np.all(off <= np.asarray(bound)))
    most = [np.max(one, initial=0.0) for one in (off, bound)]
    print("{}: {}, off by {:.3g}, bound {:.3g}".format(what, "WRONG" if wrong[-1] else "right", *most))
    print("  got", got, "\\n  expected", expected)
""",
        "nearest": '''

def nearest(got, expected):
    """The numbers of got in the order of those of expected that they are nearest to, where there are as many."""
    left = list(np.asarray(got, dtype=complex))
    pairs = expected if len(left) == len(expected) else []
    return np.array([left.pop(int(np.argmin(np.abs(np.array(left) - z)))) for z in pairs] or left)
''',
        "sine": '''

def sine(got, expected):
    """The sine of the largest angle between the spaces of the columns, 1 where their dimensions differ."""
    bases = []
    for columns in (got, expected):
        U, s, _ = np.linalg.svd(columns, full_matrices=False)
        bases.append(U[:, s > 1e-12 * max(s, default=0.0)])
    P, Q = bases
    return 1.0 if P.shape != Q.shape else np.linalg.norm(P - Q @ (Q.T @ P), 2)
''',
    },
    compared={
        "markov": MODEL + "got = np.array([D] + [C @ np.linalg.matrix_power(A, k) @ B for k in range(len(expected) - 1)])\n" + _ENTRIES,
        "transfer": MODEL + "got = (D + C @ np.linalg.solve(z * np.eye(len(A)) - A, B))[None]\n" + _ENTRIES,
        "polynomial": "got = np.poly(np.asarray(answer[0], dtype=float))[1:]\n" + _ENTRIES,
        "eigenvalues": "got = np.linalg.eigvals(np.asarray(answer[0], dtype=float))" + _PAIRS,
        "residual": """
got = np.asarray(answer, dtype=float)
off = got - expected
# what no initial state can cause, a number a kernel row
seen = [np.linalg.norm(sum(off[k : len(off) - len(row) + 1 + k] @ row[k] for k in range(len(row)))) for row in kernel_rows]
told("{what}", got, expected, np.array(seen), bound)""",
        "signal": """
got = np.asarray(answer, dtype=float)[: len(expected)]
told("{what}", got, expected, np.linalg.norm(got - expected), bound)""",
        "space": "got = np.asarray(answer, dtype=float)\n" + _SINE,
        "responses": """
A, C, Z = (np.asarray(part, dtype=float) for part in answer)
f, got = Z[: len(A)], Z[len(A) :] / units[:, None]
while len(got) < len(expected):
    f, got = A @ f, np.vstack([got, C @ f / units[:, None]])
"""
        + _SINE,
        "ranks": "got = np.ravel(answer)\n" + _EQUAL,
        "count": "got = float(answer)\n" + _EQUAL,
        "finite_zeros": _FIELD.format("finite_zeros") + _PAIRS,
        "infinite_zero_orders": _FIELD.format("infinite_zero_orders") + "got = sorted(got)\n" + _EQUAL,
        "normal_rank": _FIELD.format("normal_rank") + _EQUAL,
        "left_invertible": _FIELD.format("left_invertible") + _EQUAL,
    },
    rows=("kernel_rows = []", "kernel_rows.append(row)"),
    twice="""
from copy import deepcopy
first, second = (repr({function}({copied})) for _ in range(2))
wrong.append(first != second)
print("WRONG: two calls differ" if wrong[-1] else "right: two calls agree", first, second, sep="\\n  ")""",
    untouched="""
from copy import deepcopy
kept = [{copied}]
{function}({given})
wrong += [not np.array_equal(before, after) for before, after in zip(kept, [{given}])]
print("WRONG: arguments were changed" if any(wrong) else "right: arguments are as they were")""",
    answered='print("WRONG: answered where a refusal is due\\n  got", answer)\nwrong.append(True)',
    ending="sys.exit(any(wrong))",
    answers={},
    copied="deepcopy({})",
)

# -- Octave and MATLAB: no function is defined, because the two want it in different places; ~ and strcmp, and never ! or += --------------


def _number(value: Any) -> str:
    """Return a number as Octave, MATLAB and Julia write it."""
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, complex):
        return f"complex({_number(value.real)},{_number(value.imag)})"
    return {"nan": "NaN", "inf": "Inf", "-inf": "-Inf"}.get(repr(value), repr(value))


def _blocks(value: Any) -> Any:
    """Return the array as a matrix: a vector as a column, three axes as one block of rows below the other."""
    array = np.asarray(value)
    return array.reshape(-1, 1) if array.ndim == 1 else array.reshape(-1, array.shape[-1])


def _in_octave(name: str, value: Any) -> list[str]:
    if not isinstance(value, np.ndarray):
        return [f"{name} = {_number(value)};"]
    array = _blocks(value)
    if not array.size:
        return [f"{name} = zeros({array.shape[0]}, {array.shape[1]});"]
    return [f"{name} = [", *("  " + " ".join(map(_number, row)) for row in array.tolist()), "];"]


_TELL = """
ratio = max([0; off(:) ./ max(bound(:), realmin)]); wrong = any(~(off(:) <= bound(:))); failed = failed || wrong;
words = {'right', 'WRONG'}; fprintf('%s: %s\\n', '{what}', words{wrong + 1});
disp('  got'); disp(got); disp('  expected'); disp(expected);
fprintf('  off by %.3g, largest ratio to the bound %.3g\\n', max([0; off(:)]), ratio);"""
_OFF = " off = abs(got - expected);" + _TELL
_NEAREST = """
left = got(:); got = expected; off = inf;
if numel(left) == numel(expected)
  for k = 1:numel(expected), [~, at] = min(abs(left - expected(k))); got(k) = left(at); left(at) = []; end
  off = abs(got - expected);
else, got = left; bound = 0; end"""
_SAME = "\noff = inf; if isequal(double(sort(got(:))), double(sort(expected(:)))), off = 0; end\nbound = 0;"
_ANGLE = """
[P, S, ~] = svd(got / max([abs(got(:)); realmin]), 'econ'); P = P(:, diag(S) > 1e-12 * max([S(:); 0]));
[Q, S, ~] = svd(expected / max([abs(expected(:)); realmin]), 'econ'); Q = Q(:, diag(S) > 1e-12 * max([S(:); 0]));
off = 1; if isequal(size(P), size(Q)), off = norm(P - Q * (Q' * P)); end  % the sine of the largest angle"""
OCTAVE = Dialect(
    mark="%",
    opening="\nfailed = false;",
    assigned=_in_octave,
    # What is no refusal: a wrong index or an unknown name within the function, in Octave's words and in MATLAB's.
    call="""
try
  {answer} = {function}({given});
catch problem
  crashes = {'Octave:index-out-of-bounds', 'Octave:bad-index', 'Octave:undefined-function', ...
             'MATLAB:badsubscript', 'MATLAB:UndefinedFunction'};
  if any(strcmp(problem.identifier, crashes)), fprintf('WRONG: a crash: %s\\n', problem.message); exit(1); end
  fprintf('refused: %s\\n{refused}\\n', problem.message); exit({code});
end""",
    helpers={},
    compared={
        "markov": """
got = D_; powered = B_;
while size(got, 1) < size(expected, 1), got = [got; C_ * powered]; powered = A_ * powered; end
"""
        + _OFF[1:],
        "transfer": "got = D_ + C_ * ((z * eye(size(A_)) - A_) \\ B_);" + _OFF,
        "polynomial": "got = poly(A_); got = got(2:end)';" + _OFF,
        "eigenvalues": "got = eig(A_);" + _NEAREST + _TELL,
        "residual": """
got = answer; difference = got - expected; off = zeros(size(bound));  % what no initial state can cause, a number a kernel row
for j = 1:numel(bound)
  row = kernel_rows{j}; d = size(row, 1) - 1; seen = 0;
  for k = 0:d, seen = seen + difference(k+1:end-d+k, :) * row(k+1, :)'; end
  off(j) = norm(seen);
end"""
        + _TELL,
        "signal": "got = answer(1:size(expected, 1), :); off = norm(got - expected, 'fro');" + _TELL,
        "space": "got = answer;" + _ANGLE + _TELL,
        "responses": """
n = size(A_, 1); f = Z_(1:n, :); got = diag(1 ./ units) * Z_(n+1:end, :);
while size(got, 1) < size(expected, 1), got = [got; diag(1 ./ units) * C_ * f]; f = A_ * f; end"""
        + _ANGLE
        + _TELL,
        "ranks": "got = answer(:);" + _SAME + _TELL,
        "count": "got = answer;" + _SAME + _TELL,
        "finite_zeros": "got = answer.finite_zeros;" + _NEAREST + _TELL,
        **{of: f"got = answer.{of};{_SAME}{_TELL}" for of in ("infinite_zero_orders", "normal_rank", "left_invertible")},
    },
    rows=("kernel_rows = {};", "kernel_rows{end+1} = row;"),
    twice="""
[{names}] = {function}({given});
first = {{names}};
[{names}] = {function}({given});
second = {{names}}; failed = ~isequal(first, second);
words = {'right: two calls agree', 'WRONG: two calls differ'}; disp(words{failed + 1}); disp(first); disp(second);""",
    untouched="{function}({given});\ndisp('right: a function here gets copies of its arguments');",
    answered="disp('WRONG: answered where a refusal is due'); failed = true;",
    ending="exit(double(failed));",
    answers={"identify": "[A_, B_, C_, D_]", "identified_fault_space": "[A_, C_, Z_]"},
)

# -- Julia: several answers are a tuple; `structure` gives a NamedTuple or a Dict ---------------------------------------------------------


def _in_julia(name: str, value: Any) -> list[str]:
    if not isinstance(value, np.ndarray):
        return [f"{name} = {_number(value)}"]
    if not value.size:
        return [f"{name} = zeros({', '.join(map(str, value.shape))})"]
    if value.ndim == 1:
        return [f"{name} = [{', '.join(map(_number, value.tolist()))}]"]
    array = _blocks(value)
    rows = [f"    {' '.join(map(_number, row))}" for row in array.tolist()]
    return [f"{name} = reshape([", *rows, f"], {array.shape[0]}, {array.shape[1]})"]


_STACKED = """
function stacked(first, C, A, B, rows)
    got = first
    while size(got, 1) < rows
        got = [got; C * B]; B = A * B
    end
    return got
end"""
_IN_ORDER = """
got = nearest(got, expected)
same = length(got) == length(expected)
told("{what}", got, expected, same ? abs.(got - expected) : [Inf], same ? bound : [0.0])"""
_EQUALS = '\ntold("{what}", got, expected, sort(vec(collect(got))) == sort(vec(collect(expected))) ? 0.0 : Inf, 0.0)'
_WITHIN = '\ntold("{what}", got, expected, abs.(got - expected), bound)'
_ANGLES = '\ntold("{what}", got, expected, sine(got, expected), bound)'
JULIA = Dialect(
    mark="#",
    opening="""
using LinearAlgebra

failed = false
function told(what, got, expected, off, bound)
    wrong = any(.!(off .<= bound))
    global failed = failed || wrong
    println(what, ": ", wrong ? "WRONG" : "right", ", off by ", maximum(off), ", bound ", maximum(bound))
    println("  got      ", got, "\\n  expected ", expected)
end""",
    assigned=_in_julia,
    call="""
answer = try {function}({given}) catch problem; println("refused: ", problem); nothing end
if answer === nothing println("{refused}"); exit({code}) end""",
    helpers={
        "nearest": """
function nearest(got, expected)  # in the order of those of expected that they are nearest to
    left = collect(ComplexF64, got)
    return length(left) == length(expected) ? [splice!(left, argmin(abs.(left .- z))) for z in expected] : left
end""",
        "sine": """
basis(M) = (F = svd(M / max(mapreduce(abs, max, M; init = 0.0), floatmin())); F.U[:, F.S .> 1e-12 * reduce(max, F.S; init = 0.0)])
angle_of(P, Q) = size(P) == size(Q) ? opnorm(P - Q * (Q' * P)) : 1.0
sine(got, expected) = angle_of(basis(got), basis(expected))  # of the largest angle, 1 for unlike dimensions""",
        "field": "field(answer, name) = answer isa AbstractDict ? answer[String(name)] : getproperty(answer, name)",
        "stacked": _STACKED,
        "seen": "seen(row, off) = norm(sum(off[k:end-size(row, 1)+k, :] * row[k, :] for k in axes(row, 1)))",
    },
    compared={
        "markov": "got = stacked(answer[4], answer[3], answer[1], answer[2], size(expected, 1))" + _WITHIN,
        "transfer": "got = answer[4] + answer[3] * ((z * I - answer[1]) \\ answer[2])" + _WITHIN,
        "polynomial": "got = real(foldl((c, w) -> [c; 0] - w * [0; c], eigvals(answer[1]); init = [1.0 + 0im]))[2:end]" + _WITHIN,
        "eigenvalues": "got = eigvals(answer[1])" + _IN_ORDER,
        "residual": 'got = answer\ntold("{what}", got, expected, [seen(row, got - expected) for row in kernel_rows], bound)',
        "signal": 'got = answer[1:size(expected, 1), :]\ntold("{what}", got, expected, norm(got - expected), bound)',
        "space": "got = answer" + _ANGLES,
        "responses": """
A_, C_, Z_ = answer
got = stacked(Z_[size(A_, 1)+1:end, :] ./ units, C_ ./ units, A_, Z_[1:size(A_, 1), :], size(expected, 1))"""
        + _ANGLES,
        "ranks": "got = answer" + _EQUALS,
        "count": "got = answer" + _EQUALS,
        "finite_zeros": "got = field(answer, :finite_zeros)" + _IN_ORDER,
        **{of: f"got = field(answer, :{of}){_EQUALS}" for of in ("infinite_zero_orders", "normal_rank", "left_invertible")},
    },
    rows=("kernel_rows = Matrix{Float64}[]", "push!(kernel_rows, row)"),
    twice="""
first_answer, second_answer = {function}({copied}), {function}({copied})
failed = !isequal(first_answer, second_answer)
println(failed ? "WRONG: two calls differ" : "right: two calls agree", "\\n", first_answer, "\\n", second_answer)""",
    untouched="""
kept = deepcopy(({given},))
{function}({given})
failed = !isequal(kept, ({given},))
println(failed ? "WRONG: arguments were changed" : "right: arguments are as they were")""",
    answered='println("WRONG: answered where a refusal is due\\n", answer)\nfailed = true',
    ending="exit(failed ? 1 : 0)",
    answers={},
    copied="deepcopy({})",
)
ONCE = (MODEL.strip(), _ENTRIES.splitlines()[0])  # in a script
LANGUAGES = {"python": PYTHON, "octave": OCTAVE, "matlab": OCTAVE, "julia": JULIA}
