"""Scripts for Octave, which MATLAB reads as well: no function is defined in them, because the two want it in different places.

Matrices   the dialect; it says ~ and strcmp, and never ! or +=
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..questions import Due
from .writing import due_lines, number

ANSWERS = {
    "identify": "[A_, B_, C_, D_]",
    "identified_fault_space": "[A_, C_, Z_]",
}
# What is no refusal: a wrong index or an unknown name within the function, in Octave's words and in MATLAB's.
CRASHES = (
    "Octave:index-out-of-bounds",
    "Octave:bad-index",
    "Octave:undefined-function",
    "MATLAB:badsubscript",
    "MATLAB:UndefinedFunction",
)
NEAREST = [
    "left = got(:); got = expected; off = inf;",
    "if numel(left) == numel(expected)",
    "  for k = 1:numel(expected), [~, at] = min(abs(left - expected(k))); got(k) = left(at); left(at) = []; end",
    "  off = abs(got - expected);",
    "else, got = left; bound = 0; end",
]
EQUAL = ["off = inf; if isequal(double(sort(got(:))), double(sort(expected(:)))), off = 0; end", "bound = 0;"]
SINE = [
    "[P, S, ~] = svd(got / max([abs(got(:)); realmin]), 'econ'); P = P(:, diag(S) > 1e-12 * max([S(:); 0]));",
    "[Q, S, ~] = svd(expected / max([abs(expected(:)); realmin]), 'econ'); Q = Q(:, diag(S) > 1e-12 * max([S(:); 0]));",
    "off = 1; if isequal(size(P), size(Q)), off = norm(P - Q * (Q' * P)); end  % the sine of the largest angle",
]
COMPARED = {
    "markov": [
        "got = D_; powered = B_;",
        "while size(got, 1) < size(expected, 1), got = [got; C_ * powered]; powered = A_ * powered; end",
        "off = abs(got - expected);",
    ],
    "transfer": ["got = D_ + C_ * ((z * eye(size(A_)) - A_) \\ B_);", "off = abs(got - expected);"],
    "polynomial": ["got = poly(A_); got = got(2:end)';", "off = abs(got - expected);"],
    "eigenvalues": ["got = eig(A_);", *NEAREST],
    "residual": [
        "got = answer; difference = got - expected; off = zeros(size(bound));  % what no initial state can cause, a number a kernel row",
        "for j = 1:numel(bound)",
        "  row = kernel_rows{j}; d = size(row, 1) - 1; seen = 0;",
        "  for k = 0:d, seen = seen + difference(k+1:end-d+k, :) * row(k+1, :)'; end",
        "  off(j) = norm(seen);",
        "end",
    ],
    "signal": ["got = answer(1:size(expected, 1), :);", "off = norm(got - expected, 'fro');"],
    "space": ["got = answer;", *SINE],
    "responses": [
        "n = size(A_, 1); f = Z_(1:n, :); got = diag(1 ./ units) * Z_(n+1:end, :);",
        "while size(got, 1) < size(expected, 1), got = [got; diag(1 ./ units) * C_ * f]; f = A_ * f; end",
        *SINE,
    ],
    "ranks": ["got = answer(:);", *EQUAL],
    "count": ["got = answer;", *EQUAL],
    "finite_zeros": ["got = answer.finite_zeros;", *NEAREST],
    "infinite_zero_orders": ["got = answer.infinite_zero_orders;", *EQUAL],
    "normal_rank": ["got = answer.normal_rank;", *EQUAL],
    "left_invertible": ["got = answer.left_invertible;", *EQUAL],
}
TELL = [
    "ratio = max([0; off(:) ./ max(bound(:), realmin)]); wrong = any(~(off(:) <= bound(:))); failed = failed || wrong;",
    "words = {'right', 'WRONG'}; fprintf('%s: %s\\n', what, words{wrong + 1});",
    "disp('  got'); disp(got); disp('  expected'); disp(expected);",
    "fprintf('  off by %.3g, largest ratio to the bound %.3g\\n', max([0; off(:)]), ratio);",
]


class Matrices:
    """A function of several answers is called with that many; `structure` gives a struct."""

    def heading(self, words: Sequence[str]) -> list[str]:
        """Return the words as a comment."""
        return [*(f"% {one}".rstrip() for one in words), "", "failed = false;"]

    def value(self, name: str, value: Any) -> list[str]:
        """Return the assignment."""
        if not isinstance(value, (list, np.ndarray)):
            return [f"{name} = {number(value)};"]
        array = np.asarray(value)
        array = array.reshape(-1, 1) if array.ndim == 1 else array
        if not array.size:
            return [f"{name} = zeros({array.shape[0]}, {array.shape[1]});"]
        return [f"{name} = [", *("  " + " ".join(map(number, row.tolist())) for row in array), "];"]

    def asked(self, function: str, arguments: Sequence[str], *, refusal: bool) -> list[str]:
        """Return the call, and the end where there is no answer."""
        words = "right: there is nothing to answer" if refusal else "WRONG: an answer is due"
        return [
            "try",
            f"  {ANSWERS.get(function, 'answer')} = {function}({', '.join(arguments)});",
            "catch problem",
            f"  crashes = {{{', '.join(map(repr, CRASHES))}}};",
            "  if any(strcmp(problem.identifier, crashes)), fprintf('WRONG: a crash: %s\\n', problem.message); exit(1); end",
            f"  fprintf('refused: %s\\n{words}\\n', problem.message); exit({int(not refusal)});",
            "end",
        ]

    def compared(self, due: Due) -> list[str]:
        """Return the comparison of one thing that is due."""
        lines = due_lines(self.value, due, "kernel_rows = {};", "kernel_rows{end+1} = row;")
        what = due.quantity.replace("'", "''")
        return [*lines, f"what = '{what}';", *COMPARED[due.sides.of], *TELL]

    def twice(self, function: str, arguments: Sequence[str]) -> list[str]:
        """Return two calls and their comparison."""
        names = ANSWERS.get(function, "answer").strip("[]")
        call = f"{function}({', '.join(arguments)});"
        return [
            f"[{names}] = {call}",
            f"first = {{{names}}};",
            f"[{names}] = {call}",
            f"second = {{{names}}}; failed = ~isequal(first, second);",
            "words = {'right: two calls agree', 'WRONG: two calls differ'}; disp(words{failed + 1}); disp(first); disp(second);",
        ]

    def untouched(self, function: str, arguments: Sequence[str]) -> list[str]:
        """Return the call alone: arguments are passed by value."""
        return [f"{function}({', '.join(arguments)});", "disp('right: a function here gets copies of its arguments');"]

    def refused(self) -> list[str]:
        """Return what an answer means where a refusal is due."""
        return ["disp('WRONG: answered where a refusal is due'); failed = true;"]

    def ending(self) -> list[str]:
        """Return the exit code."""
        return ["exit(double(failed));"]
