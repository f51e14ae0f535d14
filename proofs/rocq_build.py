"""The theory in rocq/ compiled by Rocq (coqc), kept in the user's cache under the hash of its sources.

    found             the coqc on the path and its version, or None
    compiled_theory   the folder with the compiled files; compiles what is not in the cache
    kept_theory       that folder if it is there already
    installation      a digest of the Rocq and the MathComp that a compilation would use
    compile_file      compiles one more file against them; its output
    NoRocq            raised where there is no coqc, or MathComp is missing; says what to install
    CLOSED, NotProved what Rocq says of a proof without axioms, and what is raised where it does not
    BrokenTheory      raised where a file does not compile; the compiler's own words

A folder of the cache is complete or not there: files are compiled in a folder beside it that is renamed at the end, with a list of their
digests, which is read again before use. Its name tells sources, compiler and MathComp apart.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass
from functools import cache
from graphlib import TopologicalSorter
from importlib import resources
from importlib.resources.abc import Traversable
from pathlib import Path

from filelock import FileLock
from platformdirs import user_cache_path

Progress = Callable[[str, int, int], None]
INSTALL = "install Rocq with MathComp, on Debian or Ubuntu: apt install coq libcoq-mathcomp-algebra libcoq-mathcomp-zify"
OPTIONS = ("-q", "-Q", ".", "faultspace", "-w", "-all")
FILE_SECONDS = 600
DIGESTS = "digests.json"
CLOSED = "Closed under the global context"
# The last line is the notation of MathComp 1, for which the theory is written.
PROBE = """From mathcomp Require Import all_ssreflect all_algebra zify ssrZ.
Locate Library mathcomp.ssreflect.all_ssreflect.
Locate Library mathcomp.algebra.all_algebra.
Check [fieldType of rat].
"""


class NoRocq(Exception):
    """There is no coqc here, or it finds no MathComp."""


class BrokenTheory(Exception):
    """A file does not compile."""


class NotProved(Exception):
    """A theorem is missing, not accepted by the kernel, or rests on more than it."""


@dataclass(frozen=True)
class Rocq:
    """The compiler: its path and its version."""

    path: str
    version: str


@cache
def found() -> Rocq | None:
    """The coqc on the path."""
    path = shutil.which("coqc")
    if path is None:
        return None
    told = subprocess.run([path, "--print-version"], capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL)
    return Rocq(path, told.stdout.split()[0]) if told.returncode == 0 and told.stdout.strip() else None


def sources() -> dict[str, str]:
    """File name -> text, of all files of the theory."""
    folder: Traversable = resources.files(__package__).joinpath("rocq")
    return {one.name: one.read_text("utf-8") for one in sorted(folder.iterdir(), key=lambda one: one.name) if one.name.endswith(".v")}


def installation() -> str:
    """Of the compiler's version and of MathComp's outermost files, which name those below them by their digests. Raises NoRocq."""
    compiler = found()
    if compiler is None:
        raise NoRocq(f"coqc is not on the path; {INSTALL}")
    return _probed(compiler, PROBE)


@cache
def _probed(compiler: Rocq, probe: str) -> str:
    with tempfile.TemporaryDirectory() as scratch:
        (Path(scratch) / "Probe.v").write_text(probe, "utf-8")
        try:
            said = _coqc(Path(scratch) / "Probe.v", OPTIONS, FILE_SECONDS)
        except BrokenTheory as error:
            raise NoRocq(f"Rocq {compiler.version} does not find MathComp 1 with its zify ({error}); {INSTALL}") from None
    told = hashlib.sha256(compiler.version.encode())
    for place in re.findall(r"has been loaded from file\s+(\S+\.vo)", said):
        told.update(Path(place).read_bytes())
    return told.hexdigest()


def content_hash(texts: dict[str, str]) -> str:
    """Of the sources and the installation. Raises NoRocq."""
    told = hashlib.sha256(installation().encode())
    for name, text in texts.items():
        told.update(f"\0{name}\0{text}".encode())
    return told.hexdigest()[:20]


def compiled_theory(progress: Progress = lambda name, done, total: None, *, texts: dict[str, str] | None = None) -> Path:
    """The folder that holds the sources and compiled files. Raises NoRocq, BrokenTheory.

    `texts`: other sources than ours, file name -> text. `progress(file, done, total)` is told before each file.
    """
    texts = sources() if texts is None else texts
    place = _place(texts)
    if _whole(place):
        return place
    try:
        place.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        where = f"the compiled proofs cannot be kept in {place.parent}: {error.strerror}"
        raise NoRocq(f"{where}; set XDG_CACHE_HOME to a folder that can be written into") from None
    with FileLock(place.with_suffix(".lock")):  # whoever comes second finds it done
        if not _whole(place):
            shutil.rmtree(place, ignore_errors=True)
            with tempfile.TemporaryDirectory(dir=place.parent) as scratch:
                folder = Path(scratch) / "theory"
                folder.mkdir()
                for name, text in texts.items():
                    (folder / name).write_text(text, "utf-8")
                _compile_all(folder, texts, progress)
                (folder / DIGESTS).write_text(json.dumps(_digests(folder)), "utf-8")
                folder.rename(place)
    return place


def _digests(folder: Path) -> dict[str, str]:
    """Of the sources and the compiled files."""
    return {one.name: hashlib.sha256(one.read_bytes()).hexdigest() for one in sorted(folder.glob("*.v*")) if one.suffix in (".v", ".vo")}


def _whole(folder: Path) -> bool:
    """Whether the folder is there as it was compiled."""
    try:
        return bool(json.loads((folder / DIGESTS).read_text("utf-8")) == _digests(folder))
    except (OSError, ValueError):
        return False


def kept_theory() -> Path | None:
    """The folder with all of our theory, if it has been compiled before. Raises NoRocq."""
    place = _place(sources())
    return place if _whole(place) else None


def _place(texts: dict[str, str]) -> Path:
    return user_cache_path("faultspace") / "rocq" / content_hash(texts)


def compile_file(theory: Path, name: str, text: str, *, seconds: float = FILE_SECONDS) -> str:
    """What coqc prints for this file, compiled beside the theory and forgotten. Raises BrokenTheory."""
    with tempfile.TemporaryDirectory() as scratch:
        (Path(scratch) / name).write_text(text, "utf-8")
        return _coqc(Path(scratch) / name, ("-q", "-Q", str(theory), "faultspace", "-w", "-all"), seconds)


def needs(texts: dict[str, str]) -> dict[str, set[str]]:
    """File -> files of ours that it requires."""
    known = {name.removesuffix(".v") for name in texts}
    result = {}
    for name, text in texts.items():
        lines = re.findall(r"From\s+faultspace\s+Require\s+(?:Import|Export)?([\s\w]*)\.", text)
        result[name] = {f"{module}.v" for line in lines for module in line.split() if module in known}
    return result


def _compile_all(place: Path, texts: dict[str, str], progress: Progress) -> None:
    """Two at a time where one does not need the other: a compilation takes about a gigabyte."""
    order = TopologicalSorter(needs(texts))
    order.prepare()
    running: dict[Future[str], str] = {}
    done = 0
    with ThreadPoolExecutor(max_workers=min(2, os.cpu_count() or 1)) as pool:
        while order.is_active():
            for name in order.get_ready():
                running[pool.submit(_coqc, place / name, OPTIONS, FILE_SECONDS)] = name
            progress("Rocq: compiling the theory", done, len(texts))
            finished, _ = wait(running, return_when=FIRST_COMPLETED)
            for one in finished:
                try:
                    one.result()
                except Exception:
                    pool.shutdown(cancel_futures=True)
                    raise
                order.done(running.pop(one))
                done += 1


def _coqc(file: Path, options: tuple[str, ...], seconds: float) -> str:
    compiler = found()
    assert compiler is not None
    try:
        told = subprocess.run(
            [compiler.path, *options, file.name],
            cwd=file.parent,
            capture_output=True,
            text=True,
            timeout=seconds,
            check=False,
            stdin=subprocess.DEVNULL,
        )
    except subprocess.TimeoutExpired:
        raise BrokenTheory(f"{file.name}: Rocq took more than {seconds:g} s") from None
    if told.returncode == 0:
        return told.stdout
    raise BrokenTheory(f"{file.name} does not compile: {' '.join(told.stderr.split())[-600:]}")
