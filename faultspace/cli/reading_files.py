"""Open the JSON files that people exchange; what is in them is judged by `faultspace.exact` and the checker.

    read_json       the document in a file, strictly: UTF-8, no key twice, no NaN, bounded size
    read_text       the text of a file, of UTF-8 and bounded size
    read_system     the system in a file; the model of `identify` too, where floats are taken exactly
    read_experiment the experiment in a file
    write_json      a document into a file, whole or not at all
    prepare_folder  makes a folder to write into, or says why not

A name is a path, "-" for standard input or "example:NAME" for an example that comes with the package. Everything that is wrong raises
InvalidInput with one line: the file, the place in it, what was got, what was expected.
"""

from __future__ import annotations

import json
import tempfile
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

from .. import packaged_examples
from ..base.errors import InvalidInput, in_file, quote_path, shorten
from ..base.regular_files import open_regular, standard_input
from ..base.writing import reason, write_text
from ..exact.algebra.validation import MAX_FILE_BYTES
from ..exact.limits.experiments import Experiment
from ..exact.limits.experiments import read_experiment as experiment_of
from ..exact.system.systems import System, from_float_exactly
from ..exact.system.systems import read_system as system_of

MOST_PARTS = 1 << 22  # lists and objects of a document, each of which takes up to 200 bytes of memory, however few it has in the file
_HINT = "see from_float_exactly"
_ADVICE = "--floats-exactly takes them as the dyadic rationals that they are"
_TABLES = (".csv", ".tsv", ".txt", ".dat")
_IDENTIFY = "`faultspace identify` takes it"

MODEL_FORMAT = "faultspace-model/1"  # FORMAT of numeric/method/model/models.py, which would load numpy; a test compares the two
_MODEL_KEYS = ("format", "n", "n_u", "p", "n_v", "A", "B", "C", "D", "F", "G", "inputs", "outputs", "dt", "monitoring")


def read_system(name: str, *, floats_exactly: bool = False) -> System:
    """Read the system in a file; with `floats_exactly` its floats are the dyadic rationals that they are. Raises InvalidInput."""
    document = read_json(name, number=_dyadic if floats_exactly else float)
    with in_file(name):
        return system_in(document, floats_exactly=floats_exactly)


def system_in(document: Any, *, floats_exactly: bool = False) -> System:
    """Return the system that a document of a file holds. Raises InvalidInput, with what to try for models and experiments."""
    if isinstance(document, dict) and document.get("format") == MODEL_FORMAT:
        if not floats_exactly:
            raise InvalidInput(f"got a model in floats ({MODEL_FORMAT}), expected an exact system; {_ADVICE}")
        document = _system_of_model(document)
    if isinstance(document, dict) and "u_filter" in document:
        raise InvalidInput("got an experiment (it has u_filter), expected a system; `faultspace limit` takes experiments")
    try:
        return system_of(document)
    except InvalidInput as error:
        raise InvalidInput(str(error).replace(_HINT, _ADVICE)) from None


def read_experiment(name: str, *, floats_exactly: bool = False) -> Experiment:
    """Read the experiment in a file; with `floats_exactly` its floats are the dyadic rationals that they are. Raises InvalidInput."""
    document = read_json(name, number=_dyadic if floats_exactly else float)
    with in_file(name):
        if isinstance(document, dict) and "A" in document and "u_filter" not in document:
            raise InvalidInput("got a system (it has no u_filter), expected an experiment; `faultspace inspect` takes systems")
        try:
            return experiment_of(document)
        except InvalidInput as error:
            raise InvalidInput(str(error).replace(_HINT, _ADVICE)) from None


def read_json(name: str, *, number: Callable[[str], object] = float) -> Any:
    """Read the document in a file; `number` reads numbers with a point or an exponent. Raises InvalidInput."""
    with in_file(name):
        text = read_text(name, "JSON")
        if text.count("[") + text.count("{") > MOST_PARTS:
            raise InvalidInput(f"got more than {MOST_PARTS} lists and objects, expected at most that")
        try:
            return json.loads(text, object_pairs_hook=_object, parse_constant=_refused, parse_float=number, parse_int=_integer)
        except json.JSONDecodeError as error:
            place = f"line {error.lineno} column {error.colno}"
            hint = f"; measured data? {_IDENTIFY}" if Path(name).suffix.lower() in _TABLES else ""
            raise InvalidInput(f"got text that is not JSON ({error.msg.rstrip(':')}, {place}), expected JSON{hint}") from None


def read_text(name: str, kind: str = "TOML") -> str:
    """Return the text of a file. Raises InvalidInput where it cannot be read, is empty or no UTF-8; `kind` is what was expected."""
    try:
        text = _content(name, kind).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InvalidInput(f"got byte {error.object[error.start]:#04x} at {error.start}, expected {kind} in UTF-8") from None
    if not text.strip():
        raise InvalidInput(f"got an empty file, expected {kind}")
    return text


def write_json(path: Path, document: object) -> None:
    """Write the document into the file at `path`, as `write_text` does."""
    write_text(path, json.dumps(document, indent=1, sort_keys=True) + "\n")


def prepare_folder(folder: Path) -> None:
    """Make the folder and try to write into it, before anything else is done. Raises InvalidInput when that fails."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except (OSError, ValueError) as error:
        name = quote_path(str(folder))
        raise InvalidInput(f"{name}: cannot be written into ({reason(error)}), expected a folder that can") from None


def _system_of_model(model: dict[str, object]) -> dict[str, object]:
    """Return the system of a model file, which without F and G is one without faults. The entries are judged where systems are."""
    unknown = sorted(set(model) - set(_MODEL_KEYS))
    if unknown:
        raise InvalidInput(f"unknown key {shorten(unknown[0])} in a model, expected {', '.join(_MODEL_KEYS)}")
    needed = [key for key in ("n", "n_u", "p", *"ABCD") if key not in model]
    if needed:
        raise InvalidInput(f'key "{needed[0]}" is missing in a model, expected n, n_u, p, A, B, C and D')
    if not _positive(model.get("dt", 1)):
        raise InvalidInput(f"got dt = {shorten(model['dt'])} in a model, expected a positive number of seconds")
    if ("F" in model) != ("G" in model) or ("F" in model) != ("n_v" in model):
        raise InvalidInput("got some of n_v, F and G in a model, expected all or none")
    system = {key: model[key] for key in ("n", "p", *"ABCD")} | {"nu": model["n_u"], "m": model.get("n_v", 0)}
    return system | {"F": model.get("F", []), "G": model.get("G", [])}


def _positive(value: object) -> bool:
    """Say whether a number of a model, which `_dyadic` may have made a text, is positive."""
    if isinstance(value, bool) or not isinstance(value, int | float | str):
        return False
    try:
        return Fraction(value) > 0
    except (ValueError, OverflowError, ZeroDivisionError):
        return False


def _content(name: str, kind: str) -> bytes:
    try:
        if name.startswith(packaged_examples.PREFIX):
            return packaged_examples.content(name)
        if name == "-":
            content = standard_input().read(MAX_FILE_BYTES + 1)
        else:
            with open_regular(name, f"a {kind} file; a pipe is read as - from standard input") as stream:
                content = stream.read(MAX_FILE_BYTES + 1)
    except InvalidInput:
        raise
    except (OSError, ValueError) as error:
        raise InvalidInput(f"cannot be read ({reason(error)}), expected a {kind} file") from None
    if len(content) > MAX_FILE_BYTES:
        raise InvalidInput(f"got more than {MAX_FILE_BYTES} bytes, expected at most that")
    return content


def _object(pairs: list[tuple[str, object]]) -> dict[str, object]:
    document = dict(pairs)
    if len(document) != len(pairs):
        keys = [key for key, _ in pairs]
        twice = next(key for i, key in enumerate(keys) if key in keys[:i])
        raise InvalidInput(f"got key {shorten(twice)} twice in one object, expected it once")
    return document


def _refused(constant: str) -> object:
    raise InvalidInput(f"got {constant}, expected a number that JSON has")


def _integer(text: str) -> int | str:
    """Return the integer, or its own text where it is longer than Python reads: the grammar of rationals judges that just as well."""
    try:
        return int(text)
    except ValueError:
        return text


def _dyadic(text: str) -> str:
    return str(from_float_exactly(float(text), where=f"number {shorten(text)}"))
