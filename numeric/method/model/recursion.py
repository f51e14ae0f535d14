"""This runs a linear recursion s(k+1) = H s(k) + e(k) over many samples by a few products of matrices.

Steps are taken in groups: what the pushes of a group do within it is one product, and the states at the beginnings of the groups obey a
recursion of the same kind, which is a group's length shorter.

Recursion       the states of one H for pushes that come in pieces
power_basis     orthonormal matrices that span I, A, A^2, ..., and the recursion that their coordinates obey
"""

from __future__ import annotations

from functools import cached_property
from typing import NamedTuple

import numpy as np

from ....base.arrays import Array

GROUP = 16  # steps of a group: its product then costs little more than the pushes themselves
DOUBLINGS, HUGE = 21, 1e100  # powers compared up to a million steps, or to where they overflow soon
EPS = float(np.finfo(np.float64).eps)


class Recursion:
    """The recursion is s(k+1) = H s(k) + e(k) for H (d, d); states and pushes are the rows of arrays (any, w, d), w of them side by
    side."""

    def __init__(self, H: Array) -> None:
        self._step = H.T.copy()

    @cached_property
    def _powers(self) -> Array:
        powers = [np.eye(len(self._step))]
        for _ in range(GROUP):
            powers.append(powers[-1] @ self._step)
        return np.stack(powers)

    @cached_property
    def _driven(self) -> Array:
        """[l, k] is what push l of a group does to the state after k + 1 steps."""
        d = len(self._step)
        driven = np.zeros((GROUP, d, GROUP, d))
        for push in range(GROUP):
            driven[push, :, push:] = self._powers[: GROUP - push].transpose(1, 0, 2)
        return driven.reshape(GROUP * d, GROUP * d)

    @cached_property
    def _coarser(self) -> Recursion:
        return Recursion(self._powers[GROUP].T)

    def states(self, pushes: Array, start: Array) -> Array:
        """Return s(0), ..., s(M), an array (M + 1, w, d), from pushes (M, w, d) and s(0) = `start` (w, d)."""
        count, width, d = pushes.shape
        states = np.empty((count + 1, width, d))
        states[0] = start
        groups = count // GROUP if count >= 2 * GROUP else 0
        whole = groups * GROUP
        if groups:
            grouped = pushes[:whole].reshape(groups, GROUP, width, d).swapaxes(1, 2).reshape(groups * width, GROUP * d)
            driven = (grouped @ self._driven).reshape(groups, width, GROUP, d)
            starts = self._coarser.states(driven[:, :, -1], start)
            free = starts[:-1].reshape(groups * width, d) @ self._powers[1:].swapaxes(0, 1).reshape(d, GROUP * d)
            driven += free.reshape(driven.shape)
            states[1 : whole + 1].reshape(groups, GROUP, width, d)[:] = driven.swapaxes(1, 2)
        for k in range(whole, count):
            states[k + 1] = states[k] @ self._step + pushes[k]
        return states


class PowerBasis(NamedTuple):
    """The basis has A V_m = sum_i H[i, m] V_i with `matrices` V (d, n, n) and H (d, d); `identity` (d,) are the coordinates of I."""

    matrices: Array
    H: Array
    identity: Array


def power_basis(A: Array) -> PowerBasis:
    """Return a basis of the matrices that are polynomials in A (n, n): every state matrix of X(k+1) = A X(k) + I e(k) from X(0) = I or 0
    is among them, so that d <= n numbers tell it.

    The basis is orthonormal, by Arnoldi's process [GVL13], so that H amplifies no more than A. Where rounding spoils it, as the powers of
    A themselves show, all n^2 entries are taken in its place.
    """
    n = len(A)
    V, H = np.zeros((n, n * n)), np.zeros((n, n))
    if n == 0:
        return PowerBasis(V.reshape(0, 0, 0), H, np.zeros(0))
    V[0] = np.eye(n).ravel() / np.sqrt(n)
    rounding = 16 * n * EPS * float(np.linalg.norm(A))
    d = 0
    while True:
        image = (A @ V[d].reshape(n, n)).ravel()
        d += 1
        for _ in range(2):
            part = V[:d] @ image
            image -= part @ V[:d]
            H[:d, d - 1] += part
        left = float(np.linalg.norm(image))
        if d == n or left <= rounding:
            break
        H[d, d - 1], V[d] = left, image / left
    identity = np.zeros(d)
    identity[0] = np.sqrt(n)
    basis = PowerBasis(V[:d].reshape(d, n, n), H[:d, :d], identity)
    if _tells_powers(basis, A):
        return basis
    return PowerBasis(np.eye(n * n).reshape(n * n, n, n), np.kron(A, np.eye(n)).astype(np.float64), np.eye(n).ravel())


def _tells_powers(basis: PowerBasis, A: Array) -> bool:
    """Say whether the coordinates give A^k for k = 1, 2, 4, ... up to the rounding that k steps with A have."""
    power, step, largest = A, basis.H, 1.0
    for doubling in range(DOUBLINGS):
        largest = max(largest, float(np.abs(power).max()))
        if not largest < HUGE:
            return True
        error = np.tensordot(step @ basis.identity, basis.matrices, axes=1) - power
        if not np.linalg.norm(error) <= 64 * len(A) * EPS * 2**doubling * largest:
            return False
        power, step = power @ power, step @ step
    return True
