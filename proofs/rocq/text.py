"""Integers, and lists of them, as terms of Rocq. Whatever else is in a file for Rocq stands in export.py, word for word.

    whole, natural       an integer, a natural number
    sequence             a list of terms
    vector, table        a list of integers, a list of such lists
    naturals, pivoted    natural numbers; pairs of a pivot and a vector
    call                 a function and its arguments

Rocq executes what it reads: it opens and writes files where they say so. So nothing becomes text here but what has the type of an integer.
"""

from __future__ import annotations

from collections.abc import Iterable

from ..trust import checker


def whole(number: int) -> str:
    """Return an integer as a term, where integers are expected. Nothing but integers: what becomes text here is read by Rocq."""
    if type(number) is not int:
        raise TypeError(f"got a {type(number).__name__}, expected an integer")
    checker.charge(500 + (number.bit_length() ** 2 >> 9))
    return str(number) if number >= 0 else f"({number})"


def natural(number: int) -> str:
    """Write a natural number as a term, likewise."""
    if type(number) is not int or number < 0:
        raise TypeError(f"got a {type(number).__name__}, expected a natural number")
    return str(number)


def sequence(terms: Iterable[str]) -> str:
    """Write a list of terms as a term."""
    inside = "; ".join(terms)
    return f"[:: {inside}]" if inside else "[::]"


def vector(entries: Iterable[int]) -> str:
    """Write a list of integers as a term."""
    return sequence(map(whole, entries))


def table(rows: Iterable[Iterable[int]]) -> str:
    """Write a list of lists of integers as a term."""
    return sequence(map(vector, rows))


def call(function: str, *arguments: int | str) -> str:
    """Write a function and its arguments, numbers being natural ones."""
    return " ".join([function, *(one if isinstance(one, str) else f"{natural(one)}%N" for one in arguments)])


def pivoted(vectors: Iterable[tuple[int, list[int]]]) -> str:
    """Write a list of pivots with their vectors as a term."""
    return sequence(f"({natural(pivot)}%N, {vector(u)})" for pivot, u in vectors)


def naturals(numbers: Iterable[int]) -> str:
    """Write a list of natural numbers as a term."""
    return sequence(f"{natural(number)}%N" for number in numbers)
