"""Scripts for Julia, with its standard library alone.

Julia   the dialect
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..questions import Due
from .writing import due_lines, number

HELPERS = """
using LinearAlgebra

failed = false
function told(what, got, expected, off, bound)
    wrong = any(.!(off .<= bound))
    global failed = failed || wrong
    println(what, ": ", wrong ? "WRONG" : "right")
    println("  got      ", got, "\\n  expected ", expected)
    println("  off by ", maximum(off), ", largest ratio to the bound ", maximum(off ./ max.(bound, floatmin())))
end
function nearest(got, expected)  # in the order of those of expected that they are nearest to
    left = collect(ComplexF64, got)
    return length(left) == length(expected) ? [splice!(left, argmin(abs.(left .- z))) for z in expected] : left
end
basis(M) = (F = svd(M / max(mapreduce(abs, max, M; init = 0.0), floatmin())); F.U[:, F.S .> 1e-12 * reduce(max, F.S; init = 0.0)])
angle_of(P, Q) = size(P) == size(Q) ? opnorm(P - Q * (Q' * P)) : 1.0
sine(got, expected) = angle_of(basis(got), basis(expected))  # of the largest angle, 1 for unlike dimensions
matrix(x) = x isa AbstractMatrix ? x : reshape(collect(x), :, 1)
field(answer, name) = answer isa AbstractDict ? answer[String(name)] : getproperty(answer, name)
function stacked(first, C, A, B, rows)
    got = first
    while size(got, 1) < rows
        got = [got; C * B]; B = A * B
    end
    return got
end
seen(row, off) = norm(sum(off[k:end-size(row, 1)+k, :] * row[k, :] for k in axes(row, 1)))
""".strip()
PAIRS = [
    "got = nearest(got, vec(expected))",
    "same = length(got) == length(expected)",
    "told({what}, got, vec(expected), same ? abs.(got - vec(expected)) : [Inf], same ? vec(bound) : [0.0])",
]
EQUAL = ["told({what}, got, expected, sort(vec(collect(got))) == sort(vec(expected)) ? 0.0 : Inf, 0.0)"]
ENTRIES = ["told({what}, got, expected, abs.(got - expected), bound)"]
COMPARED = {
    "markov": ["got = stacked(answer[4], answer[3], answer[1], answer[2], size(expected, 1))", *ENTRIES],
    "transfer": ["got = answer[4] + answer[3] * ((z * I - answer[1]) \\ answer[2])", *ENTRIES],
    "polynomial": ["got = matrix(real(foldl((c, w) -> [c; 0] - w * [0; c], eigvals(answer[1]); init = [1.0 + 0im]))[2:end])", *ENTRIES],
    "eigenvalues": ["got = eigvals(answer[1])", *PAIRS],
    "residual": ["got = answer", "told({what}, got, expected, [seen(row, got - expected) for row in kernel_rows], vec(bound))"],
    "signal": ["got = answer[1:size(expected, 1), :]", "told({what}, got, expected, norm(got - expected), bound)"],
    "space": ["got = answer", "told({what}, got, expected, sine(got, expected), bound)"],
    "responses": [
        "A_, C_, Z_ = answer",
        "scaled = C_ ./ units",
        "got = stacked(Z_[size(A_, 1)+1:end, :] ./ units, scaled, A_, Z_[1:size(A_, 1), :], size(expected, 1))",
        "told({what}, got, expected, sine(got, expected), bound)",
    ],
    "ranks": ["got = matrix(answer)", *EQUAL],
    "count": ["got = answer", *EQUAL],
    "finite_zeros": ["got = field(answer, :finite_zeros)", *PAIRS],
    "infinite_zero_orders": ["got = matrix(field(answer, :infinite_zero_orders))", *EQUAL],
    "normal_rank": ["got = field(answer, :normal_rank)", *EQUAL],
    "left_invertible": ["got = field(answer, :left_invertible)", *EQUAL],
}


class Julia:
    """A function of several answers gives a tuple; `structure` gives a NamedTuple or a Dict."""

    def heading(self, words: Sequence[str]) -> list[str]:
        """Return the words as a comment, and what the comparisons use."""
        return [*(f"# {one}".rstrip() for one in words), "", *HELPERS.splitlines()]

    def value(self, name: str, value: Any) -> list[str]:
        """Return the assignment."""
        if not isinstance(value, (list, np.ndarray)):
            return [f"{name} = {number(value)}"]
        array = np.asarray(value)
        if not array.size:
            return [f"{name} = zeros({', '.join(map(str, array.shape))})"]
        if array.ndim == 1:
            return [f"{name} = [{', '.join(map(number, array.tolist()))}]"]
        rows = [f"    {' '.join(map(number, row))}" for row in array.tolist()]
        return [f"{name} = reshape([", *rows, f"], {array.shape[0]}, {array.shape[1]})"]

    def asked(self, function: str, arguments: Sequence[str], *, refusal: bool) -> list[str]:
        """Return the call, and the end where there is no answer."""
        words = "right: there is nothing to answer" if refusal else "WRONG: an answer is due"
        return [
            f'answer = try {function}({", ".join(arguments)}) catch problem; println("refused: ", problem); nothing end',
            f'if answer === nothing println("{words}"); exit({int(not refusal)}) end',
        ]

    def compared(self, due: Due) -> list[str]:
        """Return the comparison of one thing that is due."""
        lines = due_lines(self.value, due, "kernel_rows = Matrix{Float64}[]", "push!(kernel_rows, row)")
        what = '"' + due.quantity.replace('"', "'") + '"'
        return [*lines, *(one.replace("{what}", what) for one in COMPARED[due.sides.of])]

    def twice(self, function: str, arguments: Sequence[str]) -> list[str]:
        """Return two calls and their comparison."""
        call = f"{function}({', '.join(f'deepcopy({one})' for one in arguments)})"
        return [
            f"first_answer, second_answer = {call}, {call}",
            "failed = !isequal(first_answer, second_answer)",
            'println(failed ? "WRONG: two calls differ" : "right: two calls agree", "\\n", first_answer, "\\n", second_answer)',
        ]

    def untouched(self, function: str, arguments: Sequence[str]) -> list[str]:
        """Return the call, and a look at the arguments after it."""
        given = ", ".join(arguments)
        return [
            f"kept = deepcopy(({given},))",
            f"{function}({given})",
            f"failed = !isequal(kept, ({given},))",
            'println(failed ? "WRONG: arguments were changed" : "right: arguments are as they were")',
        ]

    def refused(self) -> list[str]:
        """Return what an answer means where a refusal is due."""
        return ['println("WRONG: answered where a refusal is due\\n", answer)', "failed = true"]

    def ending(self) -> list[str]:
        """Return the exit code."""
        return ["exit(failed ? 1 : 0)"]
