"""Certificates before the checker, which decides alone, and before Rocq's kernel where that is asked for.

check          what a certificate proves; the certificate is a dict, or the name of its file
NoCertificate  the error about a file that holds no certificate
check_file     what comes of a file: the checker's answer, whatever it is
ask_rocq       the same files, with what Rocq's kernel makes of the certificates that the checker has verified
Checked        a statement that the checker has verified
CheckedFile    a file with the checker's answer, and Rocq's
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from ..base.errors import InvalidInput, quote_path, shorten
from ..base.progress import Progress, silent
from ..base.sheets import Shown
from ..exact.limits.experiments import Experiment
from ..exact.system.systems import System
from .rocq.build import INSTALL, BrokenTheory, NoRocq, NotProved
from .rocq.recompute import Recomputed, recomputed
from .trust import checker

READING = "`faultspace inspect` takes systems, `faultspace limit` takes experiments"


class NoCertificate(InvalidInput, checker.Malformed):
    """A file that cannot be read or holds no certificate; the message names it. The checker's word for that is Malformed."""


@dataclass(frozen=True, repr=False)
class Checked(Shown):
    """A statement that the checker has verified, in words, with what it assumes; `check` returns it.

    `statement` names the systems that it is about. `assumes` is the list of what was taken for granted, empty in most cases: at most that a
    polynomial is irreducible. `rocq` is None where Rocq was not asked, else it has a `result` ("accepted", "rejected", "not covered" or
    "undecided") and a `reason`.

    Raises nothing.

    >>> import faultspace as fs
    >>> found = fs.check(fs.certify(fs.System(A=[["1/2"]], F=[[1]], C=[[1]], G=[[0]]), "infinite-zeros"))
    >>> found
    <Checked: verified>
    >>> found.statement
    'the infinite zeros have the orders [1]; for (A=[[1/2]], F=[[1]], C=[[1]], G=[[0]])'
    """

    statement: str
    assumes: list[str]
    rocq: Recomputed | None = None

    @property
    def title(self) -> str:
        """This says whether the statement holds without an assumption."""
        return "verified under an assumption" if self.assumes else "verified"

    def sheet(self) -> list[tuple[str, str]]:
        """Return the statement, the assumptions and what Rocq says, as (name, value) pairs."""
        rocq = [] if self.rocq is None else [("Rocq", f"{self.rocq.result}, {self.rocq.reason}")]
        return [("statement", self.statement), *(("assumed, not verified", text) for text in self.assumes), *rocq]

    def to_json(self) -> dict[str, Any]:
        """Return the object with the statement, the assumptions and, where Rocq was asked, its answer."""
        rocq = {} if self.rocq is None else {"rocq": {"result": self.rocq.result, "reason": self.rocq.reason}}
        return {"statement": self.statement, "assumes": self.assumes, **rocq}


@dataclass(frozen=True, repr=False)
class CheckedFile(Shown):
    """A file with the checker's answer: "file" and "result", then "kind", "statement", "assumes" and "sha256", or a "reason".

    The result is one of "verified", "verified under an assumption", "rejected" and "malformed". `rocq` is None where Rocq was not asked,
    else it has a "result", which is "not asked" for a file that the checker has not verified, and a "reason". `to_json` gives all of it as
    one dict.

    Raises nothing.

    >>> from faultspace.proofs import check_file
    >>> check_file("no-such-file.json").title
    'no-such-file.json: malformed'
    """

    answer: Mapping[str, Any]
    rocq: Mapping[str, str] | None = None

    @property
    def result(self) -> str:
        """The checker's word on the file."""
        return str(self.answer["result"])

    @property
    def title(self) -> str:
        """The file and the result."""
        return f"{quote_path(self.answer['file'])}: {self.result}"

    def sheet(self) -> list[tuple[str, str]]:
        """Return the statement or the reason, the assumptions and what Rocq says, as (name, value) pairs."""
        pairs = [(name, self.answer[name]) for name in ("statement", "reason", "sha256") if name in self.answer]
        pairs += [("assumed, not verified", text) for text in self.answer.get("assumes", ())]
        return pairs if self.rocq is None else [*pairs, ("Rocq", f"{self.rocq['result']}, {self.rocq['reason']}")]

    def to_json(self) -> dict[str, Any]:
        """Return the object that `faultspace check --json` prints of a file."""
        return {**self.answer} if self.rocq is None else {**self.answer, "rocq": {**self.rocq}}


def check(certificate: Mapping[str, Any] | str | os.PathLike[str], systems: Any = (), *, rocq: bool = False) -> Checked:
    """Decide what a certificate proves, by the checker, which trusts nothing that the certificate says.

    `faultspace check` does the same with files. The format of certificates is in proofs/trust/FORMAT.md; the checker there is four files
    that can be copied, the first of which, alone, decides ranks and behaviours over the rational numbers.

    Parameters
    ----------
    certificate : dict, str or path
        What `certify` returns, or the name of a certificate's file.
    systems : System, Experiment, dict, str, path, or a list of these
        Each must be one that the statement is about; dicts are JSON-ready.
    rocq : bool
        Whether the kernel of Rocq recomputes what the checker has verified: seconds, and minutes when the theory is first compiled.

    Returns
    -------
    Checked
        The `statement` in words, `assumes`, the list of what was not verified, and `rocq`.

    Raises
    ------
    Rejected
        Where the witness does not prove the statement.
    Malformed
        For a dict that is no certificate; for a file that holds none or cannot be read it is an InvalidInput, too, and names the file.
    InvalidInput
        For what is neither, and where Rocq is asked and is not there.

    Examples
    --------
    >>> import faultspace as fs
    >>> certificate = fs.certify(fs.System(A=[["1/2"]], F=[[1]], C=[[1]], G=[[0]]), "schur-stable")
    >>> fs.check(certificate)
    <Checked: verified>
    >>> certificate["statement"]["system"]["A"] = [["2"]]
    >>> fs.check(certificate)
    Traceback (most recent call last):
      ...
    faultspace.proofs.trust.checker.Rejected: an eigenvalue is not inside the unit circle
    """
    if isinstance(certificate, (str, os.PathLike)):
        certificate = _certificate_in(os.fspath(certificate))
    elif not isinstance(certificate, Mapping):
        raise InvalidInput(f"certificate: got {shorten(certificate)}, expected a dict as `certify` returns it, or the name of its file")
    checked = Checked(*checker.verify(certificate, [_subject(one) for one in _several(systems)]))
    return replace(checked, rocq=_recomputed([certificate])[0]) if rocq else checked


def check_file(path: str | os.PathLike[str], systems: Any = ()) -> CheckedFile:
    """The checker's answer about a certificate's file, whatever it is: what cannot be read is "malformed", and nothing of it is raised.

    Parameters
    ----------
    path : str or path
    systems : System, Experiment, dict, str, path, or a list of these
        As for `check`.

    Returns
    -------
    CheckedFile
        Its `answer` is a dict.

    Raises
    ------
    InvalidInput
        Where one of `systems` is none of these.
    Malformed, Rejected
        Where one of `systems` is no system.

    Examples
    --------
    >>> import json, tempfile, faultspace as fs
    >>> from faultspace.proofs import check_file
    >>> certificate = fs.certify(fs.System(A=[["1/2"]], F=[[1]], C=[[1]], G=[[0]]), "schur-stable")
    >>> with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
    ...     file.write(json.dumps(certificate)) > 0, file.flush(), check_file(file.name).result
    (True, None, 'verified')
    """
    return CheckedFile(checker.result_of(os.fspath(path), [_subject(one) for one in _several(systems)]))


def ask_rocq(files: Sequence[CheckedFile], progress: Progress = silent) -> list[CheckedFile]:
    """The files, each that parses with what Rocq makes of it: its kernel is asked about verified ones alone, about all of them at once.

    `files` is a list of what `check_file` returns, and `progress(stage, done, total)` hears how far the work is. Certificates are not kept
    meanwhile: a file that holds another one now is "not asked".

    Raises InvalidInput where there is no Rocq, or one that does not compile the theory.
    """
    answers: dict[int, Mapping[str, str]] = {}
    certificates: dict[int, Any] = {}
    for place, file in enumerate(files):
        if file.result == "rejected":
            answers[place] = {"result": "not asked", "reason": "only what the checker has verified is handed to Rocq"}
        elif file.result != "malformed":
            certificate = _read_again(file)
            if certificate is None:
                answers[place] = {"result": "not asked", "reason": "the file has changed since the checker has read it"}
            else:
                certificates[place] = certificate
    for place, one in zip(certificates, _recomputed([*certificates.values()], progress), strict=True):
        answers[place] = {"result": one.result, "reason": one.reason}
    return [replace(file, rocq=answers.get(place)) for place, file in enumerate(files)]


def _certificate_in(path: str) -> Any:
    try:
        found = checker.load(path)
    except checker.Malformed as error:
        raise NoCertificate(
            f"{quote_path(path)}: {error}; expected the file of a certificate, a JSON object as `certify` makes it"
        ) from None
    if isinstance(found, dict) and "format" in found and "kind" in found:
        return found
    what = f"; it looks like a system or an experiment: {READING}" if isinstance(found, dict) and "A" in found else ""
    raise NoCertificate(f"{quote_path(path)}: got JSON that is no certificate, expected one, with format, kind, statement, witness{what}")


def _several(given: Any) -> Iterable[Any]:
    """Return the systems one by one, whether there is one or a list."""
    if isinstance(given, (System, Experiment, checker.System, Mapping, str, os.PathLike)):
        return [given]
    if not isinstance(given, Iterable):
        raise InvalidInput(f"systems: got {shorten(given)}, expected a system or a list of systems, dicts or names of files")
    return given


def _subject(given: Any) -> checker.System:
    """Return what a statement must be about, as the checker reads it, on a meter of its own."""
    if isinstance(given, checker.System):
        return given
    if isinstance(given, (System, Experiment)):
        return checker.subject(given.to_json())
    return checker.subject(checker.load(os.fspath(given)) if isinstance(given, (str, os.PathLike)) else given)


def _recomputed(certificates: Sequence[Any], progress: Progress = silent) -> list[Recomputed]:
    try:
        return recomputed(certificates, progress)
    except (NoRocq, NotProved) as error:
        raise InvalidInput(f"rocq: {error}") from None
    except BrokenTheory as error:
        raise InvalidInput(f"rocq: this version of Rocq does not compile the theory ({error}); {INSTALL}") from None


def _read_again(file: CheckedFile) -> Any:
    """Return the certificate that the checker has verified; None where the file holds another one now."""
    try:
        certificate = checker.load(file.answer["file"])
        return certificate if checker.sha256(certificate) == file.answer["sha256"] else None
    except (checker.Malformed, ValueError, TypeError, MemoryError):
        return None
