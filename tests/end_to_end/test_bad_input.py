"""Whatever stands in a file, the exit code is 0, 1 or 2, and bad input gives one line that names file and place, never a traceback.

SOUND           a system that is read
changed         SOUND with other values for some keys, as the text of a file
refused         asserts that a run answered with one line on standard error, nothing on standard output and exit code 2
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from faultspace.cli import reading_files
from tests.end_to_end.commands import ROOT, Run, call, command, example
from tests.oracle.strategies import systems

SOUND = {"A": [["1/2", "1"], ["0", "-3"]], "F": [["1"], ["0"]], "C": [["1", "0"]], "G": [["0"]]}
CUBIC = {"minimal_polynomial": ["1", "-3", "-1", "4"]}


def changed(**values: object) -> str:
    """Keys with the value None are left out."""
    return json.dumps({key: value for key, value in (SOUND | values).items() if value is not None})


def refused(run: Run, *parts: str) -> None:
    """One line, told on standard error alone, with these parts in it."""
    assert (run.code, run.out) == (2, ""), run
    assert len(run.err) < 2000
    assert run.err.startswith("faultspace: ") and run.err.count("\n") == 1 and run.err.endswith("\n"), run.err
    for part in parts:
        assert part in run.err, run.err


# One of each kind: the reader's whole messages on systems are those of `tests/exact/test_bad_systems.py`.
DOCUMENTS: dict[str, tuple[str | bytes, tuple[str, ...]]] = {
    # what is no JSON
    "empty": ("", ("empty",)),
    "blank": (" \n\t ", ("empty",)),
    "truncated": (changed()[:-7], ("not JSON", "line 1")),
    "trailing": (changed() + "]", ("not JSON", "Extra data")),
    "prose": ("x(k+1) = A x(k)", ("not JSON",)),
    "binary": (b"\x93NUMPY\x01\x00v\x00", ("byte 0x93 at 0", "UTF-8")),
    "latin-1": (changed(field="é").encode().replace(b"\\u00e9", b"\xe9"), ("byte 0xe9", "UTF-8")),
    "utf-16": (changed().encode("utf-16"), ("byte 0xff at 0", "UTF-8")),
    "nul": (b"\0" * 100, ("not JSON",)),
    "nested lists": ("[" * 200_000, ("nested too deeply",)),
    "nested objects": ('{"A":' * 200_000, ("nested too deeply",)),
    "nested entry": (changed(G=[[0]]).replace("[[0]]", "[" * 900 + "]" * 900), ("G[0][0]", "rational")),
    "key twice": ('{"A": [["1"]], "A": [["2"]], "F": [["1"]], "C": [["1"]], "G": [["0"]]}', ("'A' twice",)),
    "NaN": ('{"A": [[NaN]], "F": [["1"]], "C": [["1"]], "G": [["0"]]}', ("NaN",)),
    "Infinity": ('{"A": [[-Infinity]], "F": [["1"]], "C": [["1"]], "G": [["0"]]}', ("-Infinity",)),
    # what is JSON and no system
    "null": ("null", ("None",)),
    "number": ("17", ("17",)),
    "string": ('"A"', ("'A'",)),
    "list": ("[]", ("[]",)),
    "no keys": ("{}", ('"A" is missing',)),
    "foreign": ('{"name": "left-pad", "version": "1.0.0"}', ("'name'",)),
    "certificate": ('{"format": "faultspace-certificate/1", "kind": "left-invertible", "statement": {}, "witness": {}}', ("'format'",)),
    "unknown key": (changed(E=[["1"]]), ("'E'",)),
    "lone surrogate": ('{"\\ud800": 1}', ("unknown key",)),
    # entries
    "decimal": (changed(A=[["1/2", "1.5"], ["0", "1"]]), ("A[0][1]", "'1.5'", "rational")),
    "expression": (changed(G=[["__import__('os')"]]), ("G[0][0]",)),
    "float": (changed(A=[[0.5, "1"], ["0", "1"]]), ("A[0][0]", "0.5", "--floats-exactly")),
    "integral float": (changed(G=[[1.0]]), ("G[0][0]", "1.0")),
    "overflowing float": ('{"A": [["1"]], "F": [["1"]], "C": [["1"]], "G": [[1e999]]}', ("G[0][0]", "inf")),
    "object entry": (changed(G=[[{"p": 1}]]), ("G[0][0]",)),
    "list entry": (changed(G=[[["1", "2"]]]), ("G[0][0]",)),
    "long string": (changed(G=[["9" * 50_000]]), ("G[0][0]", "65536 bits")),
    "many bits": (changed(G=[["9" * 19_729]]), ("G[0][0]", "65536 bits")),
    "long integer": (changed(G=[[0]]).replace("[[0]]", "[[%s]]" % ("9" * 30_000)), ("G[0][0]", "65536 bits")),
    "very long integer": (changed(G=[[0]]).replace("[[0]]", "[[%s]]" % ("9" * 300_000)), ("G[0][0]", "65536 bits")),
    "long float": (changed(G=[[0]]).replace("[[0]]", "[[0.%s]]" % ("3" * 300_000)), ("G[0][0]", "0.333")),
    # shapes
    "ragged": (changed(A=[["1", "2"], ["3"]]), ("A[1]", "1 entry", "expected 2")),
    "not square": (changed(A=[["1", "2"]]), ("A", "1 x 2")),
    "matrix is an object": (changed(A={"0": ["1"]}), ("A", "list of rows")),
    "astronomic nu": ('{"A": [], "F": [], "C": [], "G": [], "B": [], "D": [], "n": 0, "m": 0, "p": 0, "nu": 1%s}' % ("0" * 30), ("nu",)),
    "huge n": ('{"A": [], "F": [], "C": [], "G": [], "n": 1000000000, "m": 0, "p": 0}', ("1000000000", "512")),
    "astronomic n": ('{"A": [], "F": [], "C": [], "G": [], "n": 1%s, "m": 0, "p": 0}' % ("0" * 4000), ("512",)),
    "astronomic p": ('{"A": [], "F": [], "C": [], "G": [], "n": 0, "m": 0, "p": 1%s}' % ("0" * 9000), ("p",)),
    "large for real": (json.dumps({"A": [["1"] * 513] * 513, "F": [["1"]] * 513, "C": [["1"] * 513], "G": [["0"]]}), ("515", "512")),
    # fields
    "composite prime": (changed(A=[["1", "1"], ["0", "1"]], field={"prime": 4}), ("field.prime", "4")),
    "strong pseudoprime": (changed(A=[["1", "1"], ["0", "1"]], field={"prime": 3825123056546413051}), ("field.prime",)),
    "prime 0": (changed(field={"prime": 0}), ("field.prime", "0")),
    "prime negative": (changed(field={"prime": -7}), ("field.prime", "-7")),
    "prime a float": (changed(field={"prime": 7.0}), ("field.prime", "7.0")),
    "reducible": (changed(field={"minimal_polynomial": ["-1", "0", "1"]}), ("field.minimal_polynomial", "reducible")),
    "reducible and long": (changed(field={"minimal_polynomial": ["-4" + "0" * 9_000, "0", "1" + "0" * 9_000]}), ("reducible",)),
    "polynomial a string": (changed(field={"minimal_polynomial": "x^2 - 2"}), ("field",)),
    "a coordinate that is none": (changed(field=CUBIC, G=[[["1", "0", "x"]]]), ("G[0][0]", "'x'")),
}


@pytest.mark.parametrize("name", list(DOCUMENTS))
def test_a_bad_document_is_told_in_one_line(tmp_path: Path, name: str) -> None:
    content, parts = DOCUMENTS[name]
    path = tmp_path / "some file.json"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    refused(call("inspect", str(path), "--json"), "some file.json: ", *parts)
    refused(call("compare", "example:zeros", str(path)), "some file.json: ")
    assert call("check", str(path), "--json").code == 2
    refused(call("check", "nothing", "--system", str(path)))


def test_a_minimal_polynomial_may_be_as_long_as_any_entry(tmp_path: Path) -> None:
    path = tmp_path / "long.json"
    path.write_text(changed(field={"minimal_polynomial": ["-2", "0", "1" + "0" * 9_001]}))
    # in a process of its own: what runs tests may have lifted Python's limit on the digits of an integer
    for arguments in ([], ["--json"]):
        run = command("inspect", str(path), *arguments)
        assert (run.code, run.err) == (0, "")


def test_the_sound_document_is_read() -> None:
    assert command("inspect", "-", "--json", stdin=changed().encode()).code == 0
    assert command("inspect", "-", "--json", stdin=b"\xef\xbb\xbf" + changed().encode()).code == 0


@pytest.mark.parametrize("name", ["nested lists", "binary", "very long integer", "reducible and long"])
def test_the_same_in_a_process_of_its_own(name: str) -> None:
    """Which has the stack, the decoders and the limit on digits that a process begins with."""
    content, parts = DOCUMENTS[name]
    refused(command("inspect", "-", stdin=content if isinstance(content, bytes) else content.encode()), "-: ", *parts)


# -- files that are not there, not files, not to be read or written ----------------------------------------------------


def test_files_that_cannot_be_opened(tmp_path: Path) -> None:
    for arguments in (["inspect"], ["compare", "example:zeros"], ["check", "nothing", "--system"]):
        refused(call(*arguments, str(tmp_path / "none.json")), "none.json", "no such file")
        refused(call(*arguments, str(tmp_path)), "is a directory")
        refused(call(*arguments, ""), "''")
        refused(call(*arguments, "a\nb.json"), r"'a\nb.json'")
        refused(call(*arguments, "x" * 900), "too long")
    assert call("check", str(tmp_path)).code == call("check", str(tmp_path / "none.json")).code == 2


def test_an_example_that_is_none() -> None:
    refused(call("inspect", "example:none"), "example:none", "'none'", "paper")
    refused(call("inspect", "example:../examples/paper"), "paper")


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="permissions do not bind this user")
def test_a_file_without_permission(tmp_path: Path) -> None:
    path = tmp_path / "secret.json"
    path.write_text(changed())
    path.chmod(0)
    refused(call("inspect", str(path)), "secret.json", "permission denied")


def test_a_file_that_is_too_large(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "large.json"
    path.write_text(changed())
    monkeypatch.setattr(reading_files, "MAX_FILE_BYTES", path.stat().st_size)
    assert call("inspect", str(path)).code == 0
    monkeypatch.setattr(reading_files, "MAX_FILE_BYTES", path.stat().st_size - 1)
    refused(call("inspect", str(path)), "large.json", "bytes")


def test_a_file_of_many_small_parts_is_not_made_into_objects(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "parts.json"
    assert reading_files.MOST_PARTS <= 1 << 22
    monkeypatch.setattr(reading_files, "MOST_PARTS", 1 << 12)
    for part in ("[],", "{},"):
        path.write_text(f"[{part * (reading_files.MOST_PARTS // 2)}0]")
        refused(call("inspect", str(path)), "parts.json", "got [")
        path.write_text(f"[{part * reading_files.MOST_PARTS}0]")
        refused(call("inspect", str(path)), "parts.json", f"more than {reading_files.MOST_PARTS} lists and objects")


def test_a_source_without_end_is_not_read_to_its_end() -> None:
    if not Path("/dev/zero").exists():
        pytest.skip("no /dev/zero here")
    refused(call("inspect", "/dev/zero"), "/dev/zero", "a pipe or a device", "standard input")
    with open("/dev/zero", "rb") as endless:
        run = subprocess.run([sys.executable, "-m", "faultspace", "inspect", "-"], stdin=endless, capture_output=True, cwd=ROOT, timeout=60)
    assert run.returncode == 2 and b"67108864 bytes" in run.stderr


def test_what_does_not_fit_into_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    def exhausted(*_: object, **__: object) -> None:
        raise MemoryError

    monkeypatch.setattr("faultspace.cli.inspecting.analyze", exhausted)
    refused(call("inspect", "example:zeros"), "example:zeros", "memory")


@pytest.mark.parametrize("arguments", [["examples"], ["verify", "--effort", "quick", "--out"]], ids=["examples", "verify"])
def test_a_folder_that_cannot_be_written_into(tmp_path: Path, arguments: list[str]) -> None:
    (tmp_path / "a file").write_text("")
    refused(call(*arguments, str(tmp_path / "a file")), "a file", "cannot be written")
    refused(call(*arguments, str(tmp_path / "a file" / "below")), "below", "not a directory")
    refused(call(*arguments, "x" * 900), "too long")


def test_a_claim_that_is_none() -> None:
    run = call("verify", "--claim", "theorem-99")
    refused(run, "'theorem-99'", "theorem-1", "proposition-3")


# -- garbage -----------------------------------------------------------------------------------------------------------

SCALARS = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(-3, 3),
    st.integers(),
    st.floats(),
    st.sampled_from(["1/2", "-1", "0", "1/0", "Q", "", "a", "1e5", "0x10", "٣", "9" * 400]),
    st.text(max_size=5),
)
KNOWN = ["A", "F", "C", "G", "B", "D", "n", "m", "p", "nu", "field", "prime", "minimal_polynomial"]
KEYS = st.one_of(st.sampled_from(KNOWN), st.text(max_size=3))


def _nested(inner: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
    return st.one_of(st.lists(inner, max_size=4), st.dictionaries(KEYS, inner, max_size=6))


GARBAGE = st.recursive(SCALARS, _nested, max_leaves=20)


@st.composite
def mutated(draw: st.DrawFn, base: st.SearchStrategy[Any]) -> Any:
    """A document with one to three places replaced, removed or doubled."""
    document = json.loads(json.dumps(draw(base)))
    for _ in range(draw(st.integers(1, 3))):
        holder, key = draw(st.sampled_from(list(_places(document)) or [(None, None)]))
        if holder is None:
            break
        action = draw(st.sampled_from(["replace", "remove", "double"]))
        if action == "replace":
            holder[key] = draw(GARBAGE)
        elif action == "remove":
            del holder[key]
        elif isinstance(holder, list):
            holder.append(holder[key])
        else:
            holder[draw(KEYS)] = holder[key]
    return document


def _places(document: Any) -> Any:
    keys = range(len(document)) if isinstance(document, list) else list(document) if isinstance(document, dict) else []
    for key in keys:
        yield document, key
        yield from _places(document[key])


def answered_or_refused(run: Run) -> None:
    """Exit code 0 and JSON, with the one remark that floats taken exactly call for, or 2 and one line."""
    if run.code == 0:
        assert run.json and (run.err == "" or (run.err.count("\n") == 1 and "--floats-exactly" in run.err))
    else:
        refused(run)


SETTINGS = settings(suppress_health_check=list(HealthCheck))


@SETTINGS
@given(document=st.one_of(GARBAGE, mutated(systems(largest=2)), mutated(st.just(example("paper")))))
def test_garbage_and_mutated_systems(tmp_path: Path, document: Any) -> None:
    path = tmp_path / "garbage.json"
    path.write_text(json.dumps(document))
    answered_or_refused(call("inspect", str(path), "--json"))
    answered_or_refused(call("inspect", str(path), "--json", "--floats-exactly"))
    answered_or_refused(call("compare", str(path), "example:zeros", "--json"))


@SETTINGS
@given(content=st.one_of(st.binary(max_size=60), st.text(alphabet='{}[]":,0123456789.eE+-/ AFCGn\\u', max_size=60).map(str.encode)))
def test_bytes(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "bytes.json"
    path.write_bytes(content)
    refused(call("inspect", str(path)))
    assert call("check", str(path), "--json").code == 2


@pytest.fixture(scope="module")
def certificate() -> Any:
    """Return a certificate with a kernel and a number field in it."""
    from faultspace.exact.structure.kernel_rows import kernel_representation
    from faultspace.exact.system.systems import read_system
    from faultspace.proofs.trust.structure_certificates import window_ranks

    return window_ranks(kernel_representation(read_system(example("paper")).residual))


@SETTINGS
@given(data=st.data())
def test_mutated_certificates(tmp_path: Path, certificate: Any, data: st.DataObject) -> None:
    path = tmp_path / "certificate.json"
    path.write_text(json.dumps(data.draw(mutated(st.just(certificate)))))
    run = call("check", str(path), "--json")
    (result,) = run.json
    assert run.code == {"verified": 0, "verified under an assumption": 3, "rejected": 1, "malformed": 2}[result["result"]]
