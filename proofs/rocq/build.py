"""The theory compiled by Rocq (coqc), kept in the user's cache under the hash of its sources.

    found             the coqc on the path and its version, or None
    Rocq              that compiler: its path and its version
    compiled_theory   the folder with the compiled files; compiles what is not in the cache
    kept_theory       that folder if it is there already
    forget            removes it, and the answers that were kept about it
    installation      a digest of the Rocq and the MathComp that a compilation would use
    believed          coqc, coqchk and MathComp, where they are and which they are
    environment       the variables that these programs are given: none that would have them load something else
    compile_file      compiles one more file against them; its output
    compiled_again    the compiled form of a few sources, made from them now and not taken from the cache
    NoRocq            raised where there is no coqc, or MathComp is missing; says what to install
    CLOSED, NotProved what Rocq prints of a proof without axioms, and what is raised where it does not
    BrokenTheory      raised where a file does not compile; the compiler's own words
    Poisoned          a BrokenTheory: the cache holds something else than our sources compiled, or others can write into it

A folder of the cache is complete or not there: files are compiled in a folder beside it that is renamed at the end, with a list of their
digests. It is flat, whatever the folders of the sources. Its name tells sources, compiler and MathComp apart. Before each use its sources
are compared with ours, the digests are computed again, and it must belong to the user, nobody else being able to write into it or to
enter it. This notices what was damaged and what was exchanged by others, or without much care. Who can write as the user and takes the
care to forge compiled files, digests and answers is not noticed here, but by compiling anew (`rocq_recheck`).

coqc runs under limits of time, memory and output, and with a home of its own that is removed.
"""

from __future__ import annotations

import errno
import hashlib
import json
import os
import re
import shutil
import stat
import subprocess
import tempfile
from collections.abc import Mapping
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass
from functools import cache
from graphlib import TopologicalSorter
from pathlib import Path
from typing import IO

from filelock import FileLock
from platformdirs import user_cache_path

from ...base.processes import ending_with_us
from ...base.progress import Progress, silent
from .sources import needs, sources

INSTALL = "install Rocq with MathComp, on Debian or Ubuntu: apt install coq libcoq-mathcomp-algebra libcoq-mathcomp-zify"
OPTIONS = ("-q", "-Q", ".", "faultspace", "-w", "-all")
FILE_SECONDS = 600
MOST_MEMORY, MOST_WRITTEN, MOST_PRINTED = 8 * 2**30, 256 * 2**20, 8 * 2**20
# Words of Rocq that write, load or run something outside: in no file that is written here for it to compile.
OUTSIDE = re.compile(r"\b(?:Redirect|Extraction|Load|Cd|Drop|Declare\s+ML|Add\s+(?:Rec\s+)?(?:LoadPath|ML))\b")
# OCaml 5 sets address space aside for 128 cores, more than the limit; Rocq uses one. The rest is what Rocq chooses where nothing is set.
ONE_CORE = "d=1,s=32M,o=120"
LIMITED = 'ulimit -t "$1"; ulimit -v "$2" 2>/dev/null; ulimit -f "$3"; shift 3; exec "$@"'
# All that coqc and coqchk are given of the environment. COQPATH, ROCQPATH, OCAMLPATH, COQLIB, LD_PRELOAD and others like these would have
# them load other files than the installed ones, and nobody would see it; so what is not named here is dropped.
GIVEN = ("PATH", "LANG", "LC_ALL", "LC_CTYPE", "TZ")
DIGESTS = "digests.json"
CLOSED = "Closed under the global context"
# Where MathComp is, without loading it, which takes twenty times as long.
PLACES = """Locate Library mathcomp.ssreflect.all_ssreflect.
Locate Library mathcomp.algebra.all_algebra.
"""
# The last line holds in MathComp 1 and in MathComp 2; the theory is written for both.
PROBE = """From mathcomp Require Import all_ssreflect all_algebra zify ssrZ.
Check [the fieldType of rat : Type].
"""


class NoRocq(Exception):
    """Raised where there is no coqc, or where it finds no MathComp."""


class BrokenTheory(Exception):
    """Raised where a file does not compile."""


class Poisoned(BrokenTheory):
    """Raised where the compiled theory in the cache is not believed; it says why, and what to do."""


class NotProved(Exception):
    """Raised where a theorem is missing, is not accepted by the kernel, or rests on more than it."""


@dataclass(frozen=True)
class Rocq:
    """A compiler has a path and a version."""

    path: str
    version: str


@cache
def found() -> Rocq | None:
    """Return the coqc on the path with its version, or None."""
    path = shutil.which("coqc")
    if path is None:
        return None
    command = [path, "--print-version"]
    run = subprocess.run(command, capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL, env=environment())
    return Rocq(path, run.stdout.split()[0]) if run.returncode == 0 and run.stdout.strip() else None


def environment(home: str | None = None) -> dict[str, str]:
    """Return the variables for coqc and coqchk, with a home of their own where one is given."""
    own = dict.fromkeys(("HOME", "TMPDIR", "XDG_CONFIG_HOME", "XDG_DATA_HOME"), home) if home else {}
    return {**{name: os.environ[name] for name in GIVEN if name in os.environ}, **own, "OCAMLRUNPARAM": ONE_CORE}


def believed() -> dict[str, str | None]:
    """Return by what a proof is checked: the files of coqc and coqchk (None: not there), Rocq's version, the folder of MathComp, and the
    SHA-256 of its outermost files, which stands for its version. Raises NoRocq."""
    compiler, checker = found(), shutil.which("coqchk")
    if compiler is None:
        raise NoRocq(f"coqc is not on the path; {INSTALL}")
    places = [Path(place) for place in _mathcomp(compiler)]
    return {
        "coqc": os.path.realpath(compiler.path),
        "version": compiler.version,
        "coqchk": None if checker is None else os.path.realpath(checker),
        "mathcomp": ", ".join(sorted({str(place.parents[1]) for place in places})),
        "mathcomp_sha256": hashlib.sha256(b"".join(place.read_bytes() for place in places)).hexdigest(),
    }


def told(believed: Mapping[str, str | None]) -> str:
    """Return this in words."""
    coqchk = believed["coqchk"] or "not on the path"
    mathcomp = f"MathComp {believed['mathcomp']} (SHA-256 {(believed['mathcomp_sha256'] or '')[:12]})"
    return f"coqc {believed['coqc']} ({believed['version']}), coqchk {coqchk}, {mathcomp}"


def installation() -> str:
    """Return a digest of the compiler's version and of MathComp's outermost files, which name those below them by their digests. Raises
    NoRocq.

    MathComp is found and not loaded: what was compiled with these files, and what Rocq answered then, is so whatever lies there now, and
    whenever coqc is asked something new, it loads the files and compares the digests that they name."""
    compiler = found()
    if compiler is None:
        raise NoRocq(f"coqc is not on the path; {INSTALL}")
    digest = hashlib.sha256(compiler.version.encode())
    for place in _mathcomp(compiler):
        digest.update(Path(place).read_bytes())
    return digest.hexdigest()


def _mathcomp(compiler: Rocq) -> list[str]:
    """Return the outermost files of MathComp, where coqc finds them."""
    return re.findall(r"is bound to file\s+(\S+\.vo)", _probed(compiler, PLACES))


@cache
def _probed(compiler: Rocq, probe: str) -> str:
    """Return what coqc prints. Raises NoRocq where it does not accept the probe."""
    with tempfile.TemporaryDirectory() as scratch:
        (Path(scratch) / "Probe.v").write_text(probe, "utf-8")
        try:
            return _coqc(Path(scratch) / "Probe.v", OPTIONS, FILE_SECONDS)
        except BrokenTheory as error:
            raise NoRocq(f"Rocq {compiler.version} does not find MathComp with its zify ({error}); {INSTALL}") from None


def content_hash(texts: dict[str, str]) -> str:
    """Return a hash of the sources and of the installation. Raises NoRocq."""
    digest = hashlib.sha256(installation().encode())
    for name, text in texts.items():
        digest.update(f"\0{name}\0{text}".encode())
    return digest.hexdigest()[:20]


def compiled_theory(progress: Progress = silent, *, texts: dict[str, str] | None = None) -> Path:
    """Return the folder that holds the sources and the compiled files. Raises NoRocq, BrokenTheory.

    `texts`: other sources than ours, file name -> text. `progress(words, done, total)` is called before each file.
    """
    texts = sources() if texts is None else texts
    place = _place(texts)
    if _whole(place, texts):
        return place
    compiler = found()
    assert compiler is not None  # as `_place` has seen
    _probed(compiler, PROBE)
    try:
        _made_private(place.parent)
    except OSError as error:
        where = f"the compiled proofs cannot be kept in {place.parent}: {error.strerror}"
        raise NoRocq(f"{where}; set XDG_CACHE_HOME to a folder that can be written into") from None
    with FileLock(place.with_suffix(".lock")):  # whoever comes second finds it done
        if not _whole(place, texts):
            shutil.rmtree(place, ignore_errors=True)
            with tempfile.TemporaryDirectory(dir=place.parent) as scratch:
                folder = Path(scratch) / "theory"
                folder.mkdir(mode=0o700)
                for name, text in texts.items():
                    (folder / name).write_text(text, "utf-8")
                _compile_all(folder, texts, progress)
                (folder / DIGESTS).write_text(json.dumps(_digests(folder)), "utf-8")
                folder.rename(place)
    return place


def _made_private(folder: Path) -> None:
    """Make the folder of our cache and the one above it, so that nobody else can write into them. Raises OSError."""
    for one in (folder.parent, folder):
        one.mkdir(parents=True, exist_ok=True, mode=0o700)
        status = one.lstat()
        if not stat.S_ISDIR(status.st_mode):
            raise NotADirectoryError(errno.ENOTDIR, f"{one} is a link")
        if hasattr(os, "getuid") and status.st_uid != os.getuid():
            raise PermissionError(errno.EPERM, f"{one} belongs to another user")
        if status.st_mode & 0o022:
            one.chmod(stat.S_IMODE(status.st_mode) & ~0o022)


def _digests(folder: Path) -> dict[str, str]:
    """Return the digests of the sources and of the compiled files, by name."""
    return {one.name: hashlib.sha256(one.read_bytes()).hexdigest() for one in sorted(folder.glob("*.v*")) if one.suffix in (".v", ".vo")}


def _whole(folder: Path, texts: dict[str, str]) -> bool:
    """Return whether the folder is there as it was compiled, from these sources. Raises Poisoned where somebody else may have put it
    there.
    """
    try:
        same = bool(json.loads((folder / DIGESTS).read_text("utf-8")) == _digests(folder))
    except (OSError, ValueError):
        return False
    if not _own(folder):
        raise Poisoned(_not_believed(folder, "others than you can write into it or above it, or it holds a file or link that is not yours"))
    if not same:
        return False
    held = {one.name: one.read_bytes() for one in folder.glob("*.v")}
    if held != {name: text.encode() for name, text in texts.items()}:
        names = [name for name in {*held, *texts} if held.get(name) != texts.get(name, "").encode() or name not in texts]
        raise Poisoned(_not_believed(folder, f"its sources are not those of this package: {', '.join(sorted(names)[:4])}"))
    if {one.stem for one in folder.glob("*.vo")} != {name.removesuffix(".v") for name in texts}:
        raise Poisoned(_not_believed(folder, "it holds other compiled files than those of its sources"))
    return True


def _not_believed(folder: Path, why: str) -> str:
    return f"the compiled theory in {folder} is not believed: {why}; faultspace verify --recheck removes it and compiles anew"


def _own(folder: Path) -> bool:
    """Return whether folder and files belong to the user, no file is a link, and nobody else can enter the folder or exchange it."""
    if not hasattr(os, "getuid"):
        return True
    me = os.getuid()
    above = [one.lstat() for one in (folder.parent.parent, folder.parent)]
    here, inside = folder.lstat(), [one.lstat() for one in folder.iterdir()]
    return (
        all(one.st_uid == me for one in (*above, here, *inside))
        and not any(one.st_mode & 0o022 for one in above)
        and not here.st_mode & 0o077
        and stat.S_ISDIR(here.st_mode)
        and not any(stat.S_ISLNK(one.st_mode) for one in inside)
    )


def forget(texts: dict[str, str]) -> None:
    """Remove the compiled theory of these sources from the cache, with all answers that were kept about it. Raises NoRocq."""
    place = _place(texts)
    shutil.rmtree(place, ignore_errors=True)
    for one in place.parent.glob(f"{place.name}.*"):
        one.unlink(missing_ok=True)


def kept_theory(texts: dict[str, str]) -> Path | None:
    """Return the folder with the theory of these sources, if it has been compiled before. Raises NoRocq."""
    place = _place(texts)
    return place if _whole(place, texts) else None


def _place(texts: dict[str, str]) -> Path:
    return user_cache_path("faultspace") / "rocq" / content_hash(texts)


def compile_file(theory: Path, name: str, text: str, *, seconds: float = FILE_SECONDS) -> str:
    """Return what coqc prints for this file, which is compiled beside the theory and forgotten. Raises BrokenTheory.

    It is refused where it has a word that would make Rocq write or load something outside.
    """
    if (outside := OUTSIDE.search(text)) is not None:
        raise BrokenTheory(f"{name} is not given to Rocq: it says {outside[0]}")
    with tempfile.TemporaryDirectory() as scratch:
        (Path(scratch) / name).write_text(text, "utf-8")
        return _coqc(Path(scratch) / name, ("-q", "-Q", str(theory), "faultspace", "-w", "-all"), seconds)


def compiled_again(texts: Mapping[str, str]) -> dict[str, bytes]:
    """Return for each file what coqc makes of it; these sources need no others. Raises BrokenTheory.

    The same version of Rocq makes the same bytes of the same sources.
    """
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        for name, text in texts.items():
            (folder / name).write_text(text, "utf-8")
        _compile_all(folder, texts, silent)
        return {name: (folder / name).with_suffix(".vo").read_bytes() for name in texts}


def _compile_all(place: Path, texts: Mapping[str, str], progress: Progress) -> None:
    """Compiles two files at a time where one does not need the other: a compilation takes about a gigabyte."""
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
    """Return what coqc prints for the file, in its folder. Raises BrokenTheory where it fails or goes beyond the limits."""
    compiler = found()
    assert compiler is not None
    limits = (str(int(seconds) + 1), str(MOST_MEMORY // 1024), str(MOST_WRITTEN // 512))
    with tempfile.TemporaryDirectory() as home, tempfile.TemporaryFile() as printed, tempfile.TemporaryFile() as complaints:
        try:
            run = subprocess.run(
                ["/bin/sh", "-c", LIMITED, "sh", *limits, compiler.path, *options, file.name],
                cwd=file.parent,
                env=environment(home),
                stdout=printed,
                stderr=complaints,
                timeout=seconds,
                check=False,
                stdin=subprocess.DEVNULL,
                preexec_fn=ending_with_us(),
            )
        except subprocess.TimeoutExpired:
            raise BrokenTheory(f"{file.name}: Rocq took more than {seconds:g} s") from None
        output, errors = (_beginning(one) for one in (printed, complaints))
    if run.returncode == 0 and len(output) < MOST_PRINTED:
        return output
    if run.returncode < 0 or len(output) == MOST_PRINTED or "out of memory" in errors.lower():
        raise BrokenTheory(
            f"{file.name}: Rocq was stopped: it may take {seconds:g} s, {MOST_MEMORY >> 30} GB of memory, files of {MOST_WRITTEN >> 20} MB "
            f"and print {MOST_PRINTED >> 20} MB"
        )
    raise BrokenTheory(f"{file.name} does not compile: {' '.join(errors.split())[-600:]}")


def _beginning(stream: IO[bytes]) -> str:
    stream.seek(0)
    return stream.read(MOST_PRINTED).decode("utf-8", "replace")
