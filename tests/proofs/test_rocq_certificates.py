"""Rocq's kernel and the checker agree: on every certificate of a run of a covered kind, and on well-formed mutations of small ones."""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Callable, Iterator
from importlib import resources
from itertools import groupby, product
from pathlib import Path
from typing import Any

import pytest

from faultspace.exact.algebra.fields import QQ, PrimeField
from faultspace.proofs.rocq import build as rocq_build
from faultspace.proofs.rocq import export as rocq_export
from faultspace.proofs.rocq.build import NotProved
from faultspace.proofs.rocq.export import COVERED, exported, translated
from faultspace.proofs.rocq.listed import NotCovered
from faultspace.proofs.rocq.numbered import numbers_of
from faultspace.proofs.rocq.recompute import ACCEPTED, decided, proved, recomputed, theory
from faultspace.proofs.rocq.sources import sources
from faultspace.proofs.rocq.statements import VOCABULARY, read
from faultspace.proofs.rocq.terms import Terms
from faultspace.proofs.trust import checker
from tests.end_to_end.commands import call
from tests.proofs.examples import GONE, RANKS, ROOTED, SQRT2, K, S, certificates, spoiled, written
from tests.proofs.test_mutations import SYSTEMS, mutated, mutations, of_one_system, of_two_systems
from tests.proofs.test_rocq_hints import translations
from tests.thorough import THOROUGH

needs_rocq = pytest.mark.skipif(rocq_build.found() is None, reason=rocq_build.INSTALL)
EVERY = 307  # mutation is tried
ONLY_RATIONAL = "of experiments over Q alone"
FALSE = spoiled(RANKS, ("statement.normal_rank", 2))
REDUCIBLE = spoiled(ROOTED, (f"{S}.field.minimal_polynomial", ["-1", "0", "1"]), ("witness.irreducible", GONE), ("witness.root", 1))


def covered(certificate: dict[str, Any]) -> bool:
    """Return whether the certificate is of a covered kind, without a nulling subspace."""
    return certificate["kind"] in COVERED and '"nulling"' not in json.dumps(certificate)


def over(certificate: dict[str, Any]) -> str:
    """Return the field of a certificate: Q, GF or Q(a)."""
    text = json.dumps(certificate)
    return "Q(a)" if '"minimal_polynomial"' in text else "GF" if '"field": {"prime"' in text else "Q"


def kind_and_field(certificate: dict[str, Any]) -> tuple[str, str]:
    """Return the kind and the field of a certificate."""
    return certificate["kind"], over(certificate)


def small_ones() -> list[dict[str, Any]]:
    """Returns certificates of every covered kind, each once, systems without states, faults or outputs among them."""
    made = [c for system in SYSTEMS.values() for c in of_one_system(system)]
    fields = [c for field in (QQ, PrimeField(3), SQRT2) for c in certificates(field)]
    every = [written(c) for c in [*made, *of_two_systems(), *fields] if covered(c)]
    return [*{json.dumps(c): c for c in every}.values()]


@needs_rocq
@pytest.mark.slow
def test_the_kernel_proves_every_certificate_of_a_run_of_a_covered_kind(certificates_of_a_run: Path) -> None:
    made = [json.loads(one.read_text("utf-8")) for one in sorted(certificates_of_a_run.glob("*-*.json"))]
    about = [c for c in made if covered(c)]
    assert {c["kind"] for c in about} >= {*COVERED} - {"behaviour-inclusion"} and {*map(over, about)} == {"Q", "GF", "Q(a)"}
    assert recomputed(about) == [ACCEPTED] * len(about)


@pytest.mark.programs
@needs_rocq
def test_the_kernel_proves_small_certificates_of_every_covered_kind() -> None:
    every_one = sorted(small_ones(), key=kind_and_field)
    about = [c for _, alike in groupby(every_one, key=kind_and_field) for c in [*alike][:: 1 if THOROUGH else 9]]
    every = {(kind, field) for kind in COVERED for field in ("Q", "GF", "Q(a)")}
    assert {kind_and_field(c) for c in about} == every - {("schur-stable", "GF"), *product(("moesp-limit", "input-limit"), ("GF", "Q(a)"))}
    assert recomputed(about) == [ACCEPTED] * len(about)


@pytest.mark.programs
@needs_rocq
def test_rocq_and_the_checker_agree_on_mutations() -> None:
    every = [(c, path, value) for c in small_ones() for path, value in mutations(c)]
    found = [*translations(((one[0], mutated(*one)) for one in every[::EVERY]), ["input-limit"])]
    tried, terms, verdicts = zip(*found, strict=True)
    for ours, rocq, candidate in zip(verdicts, decided(terms, theory()), tried, strict=True):
        assert ours == rocq, candidate
    for field in ("Q", "GF", "Q(a)"):
        of_field = [verdict for verdict, candidate in zip(verdicts, tried, strict=True) if over(candidate) == field]
        assert min(of_field.count(True), of_field.count(False)) > 10, field


def test_what_is_stated_is_read_before_any_file_of_proofs_is_imported() -> None:
    """A file of proofs could have another meaning for a word: only what the locks hold may stand before the last statement."""
    text = rocq_export.written([exported(certificate) for certificate in small_ones()[:40]])
    before = text[: text.rindex("Definition said : Prop")]
    required = re.findall(r"From faultspace Require Import ([\w ]+)\.", before)
    assert len(required) == 1 and all(VOCABULARY.fullmatch(f"{name}.v") for name in required[0].split())
    words = {name for said in re.findall(r"Definition said : Prop := (.*)\.\n", text) for name in re.findall(r"[A-Za-z_]\w*", said)}
    ours = {name for file in sources() for name in re.findall(r"^(?:Definition|Fixpoint|Record) (\w+)", sources()[file], re.MULTILINE)}
    locked = {name for found in read(sources()).words.values() for name in found}
    own = {name for terms in map(exported, small_ones()[:40]) for name, *_ in terms.definitions}
    bound = set(" ".join(re.findall(r"(?:forall|fun|exists) ([\w ]+)", text)).split())
    assert words & ours <= locked | own | bound, "and the statement uses no word of another file"


@pytest.mark.programs
@needs_rocq
def test_what_computes_to_false_is_no_theorem() -> None:
    terms = translated(FALSE)
    assert decided([terms], theory()) == [False]
    with pytest.raises(NotProved, match="does not compile"):
        proved([terms], theory())
    assert [one.result for one in recomputed([FALSE, RANKS])] == ["rejected", "accepted"]


@pytest.mark.programs
@needs_rocq
def test_a_theorem_that_rests_on_an_axiom_does_not_count(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(rocq_export, "HEAD", f"{rocq_export.HEAD}Axiom cheat : forall b, b = true -> false.\n")
    with pytest.raises(NotProved, match=r"rests on more than the kernel.*cheat"):
        proved([Terms((), "true", "false", "cheat _")], theory())


@pytest.mark.programs
@needs_rocq
def test_what_takes_too_long_is_undecided() -> None:
    (one,) = recomputed([RANKS], seconds=0.01)
    assert one.result == "undecided"
    assert "took more than 0.01 s" in one.reason


# -- what is in a certificate never becomes source ------------------------------------------------------------------------

MARK = "Redirect"
SOURCE = f'0%N, [:: [:: 0]])]. {MARK} "chosen" Check tt. Definition junk : seq kernel_row := [:: (0'
NO_NUMBERS = (SOURCE, MARK, "1_0", " 1", "1 ", "\u0661", "0x1", "1%N", "(* 1", True, 1.0, [SOURCE], {SOURCE: SOURCE}, None)


def everywhere(node: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """Yields the places in a certificate: every key and every item."""
    for key in node if isinstance(node, dict) else range(len(node)) if isinstance(node, list) else ():
        yield (*path, key)
        yield from everywhere(node[key], (*path, key))


def text_of(certificate: dict[str, Any], write: Callable[[dict[str, Any]], Terms]) -> str | None:
    """Returns what Rocq would read; None where the exporter refuses."""
    try:
        return f"{(terms := write(certificate)).claimed()}{terms.proof()} {terms.check}"
    except (checker.Malformed, checker.Rejected, NotCovered):
        return None


def words_of(text: str) -> set[str]:
    """Returns the names in a text."""
    return set(re.findall(r"[A-Za-z_]\w*", text))


@pytest.mark.programs
def test_no_string_of_a_certificate_reaches_rocq() -> None:
    sound = [text_of(certificate, exported) for certificate in small_ones()]
    words = set[str]().union(*(words_of(text or "") for text in sound))  # ours, and no others
    assert None not in sound and MARK not in words and len(words) < 300
    seen = Counter[str]()
    longest = sorted(small_ones(), key=lambda c: len(json.dumps(c)))
    for certificate in {json.dumps([c["kind"], sorted(c["witness"]), c["statement"].get("matrix")]): c for c in longest}.values():
        step = 60 if certificate["kind"] in ("moesp-limit", "input-limit") else 8  # these are long, and take the checker longer
        for path in list(everywhere(certificate))[:: 1 if THOROUGH else step]:
            for value in NO_NUMBERS:
                candidate = mutated(certificate, path, value)
                assert text_of(candidate, exported) is None or value is None, (path, value)
                if path != ("kind",):
                    assert words_of(text_of(candidate, translated) or "") <= words, (path, value)
                seen[certificate["kind"]] += 1
    assert seen.keys() == COVERED and sum(seen.values()) > (10_000 if THOROUGH else 1_200)


@pytest.mark.programs
def test_a_pivot_that_carries_source_is_refused(tmp_path: Path) -> None:
    # It closed the definition of the rows, put another system under the name of the one in the statement, and wrote a file.
    theirs = dict((name, term) for name, _, term in exported(RANKS).definitions)
    chosen = tmp_path / "chosen"
    source = theirs["rows"].removeprefix("[:: (") + (
        f".\nModule Inner. Definition system := {theirs['system']}. Definition words : evidence := {theirs['lower']}.\n"
        "Notation check_window_ranks := (fun n m p r e k l s w (_ : evidence) => "
        "CheckRanks.check_window_ranks n m p r e k l s w words) (only parsing). End Inner. Import Inner.\n"
        f'Redirect "{chosen}" Check tt.\nDefinition junk : seq kernel_row := [:: (0'
    )
    forged = spoiled(RANKS, (f"{S}.C", [["0"], ["0"]]), (f"{K}.0.pivot", source))
    for write in exported, translated:
        with pytest.raises(checker.Malformed, match="expected an integer"):
            write(forged)
    if rocq_build.found() is not None:
        assert [one.result for one in recomputed([forged, RANKS])] == ["rejected", "accepted"]
        assert list(tmp_path.iterdir()) == []


def test_every_kind_is_covered_and_another_is_not() -> None:
    assert checker.KINDS.keys() == COVERED
    with pytest.raises(NotCovered, match="do not speak of the kind"):
        translated({**RANKS, "kind": "another"})


def test_a_reducible_polynomial_is_not_covered() -> None:
    checker.verify(REDUCIBLE)
    with pytest.raises(NotCovered, match="reducible"):
        exported(REDUCIBLE)
    with pytest.raises(NotCovered, match="reducible"):
        numbers_of(checker.subject(REDUCIBLE["statement"]["system"]).field)


def test_the_format_tells_what_is_covered_and_by_which_theorem() -> None:
    texts = sources()
    _, _, section = resources.files("faultspace.proofs").joinpath("trust/FORMAT.md").read_text("utf-8").partition("## What Rocq recomputes")
    rows = dict(re.findall(r"^\| `([\w-]+)` \| (.*) \|$", section, re.M))
    assert set(rows) == set(COVERED)
    for cells in rows.values():
        over_rationals, over_fields = cells.split(" | ")
        assert (over_fields == ONLY_RATIONAL) == (re.findall(r"FieldLimits|FieldInputs", over_rationals) != [])
        for theorems in [over_rationals] if over_fields == ONLY_RATIONAL else [over_rationals, over_fields]:
            module, *_ = re.findall(r"`(\w+)\.", theorems)
            text = texts[f"{module}.v"]
            assert all(f"Theorem {name} " in text for name in re.findall(r"`(?:\w+\.)?(\w+)`", theorems))


def test_what_is_no_prime_is_rejected_before() -> None:
    with pytest.raises(checker.Rejected, match="not a prime"):
        exported(spoiled(RANKS, ("witness.prime", 2**61)))


@pytest.mark.programs
@needs_rocq
def test_the_command_tells_what_rocq_says(tmp_path: Path) -> None:
    files = []
    for name, certificate in {"true": RANKS, "false": FALSE, "reducible": REDUCIBLE}.items():
        files.append(str(tmp_path / f"{name}.json"))
        Path(files[-1]).write_text(json.dumps(certificate), "utf-8")
    run = call("check", "--rocq", files[0])
    assert run.code == 0
    assert "Rocq: accepted" in run.out
    run = call("check", "--rocq", "--json", *files)
    assert run.code == 1
    assert [one["rocq"]["result"] for one in json.loads(run.out)] == ["accepted", "not asked", "not covered"]
    assert call("check", "--rocq", files[2]).code == 1


def test_without_rocq_the_command_says_what_to_install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(rocq_build, "found", lambda: None)
    (tmp_path / "true.json").write_text(json.dumps(RANKS), "utf-8")
    run = call("check", "--rocq", str(tmp_path / "true.json"))
    assert run.code == 2
    assert "apt install coq libcoq-mathcomp-algebra libcoq-mathcomp-zify" in run.err
    assert call("check", str(tmp_path / "true.json")).code == 0
