"""The theory is compiled anew whatever the cache holds, and read once more by the second checker, coqchk.

    recheck        removes the compiled theory from the cache, compiles it from our sources, has coqchk read it where coqchk is there
    second_check   has coqchk read all files of a compiled theory; raises NotProved where one rests on anything

This is what `faultspace verify --recheck` does first: it believes nothing that was compiled before.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import tempfile
from pathlib import Path

from ...base.processes import ending_with_us
from ...base.progress import Progress, silent
from .build import NotProved, compiled_theory, environment, forget
from .locks import held
from .sources import sources

SECONDS = 1800
AXIOMS = "Axioms"
# What coqchk lists that a theory rests on; each must be nothing, but for the axioms of which PRIMITIVE speaks.
HEADINGS = (
    AXIOMS,
    "Constants/Inductives relying on type-in-type",
    "Constants/Inductives relying on unsafe (co)fixpoints",
    "Inductives whose positivity is assumed",
)
# Operations of machine integers and strings are the kernel's own. They have no body, so coqchk lists them with the axioms of every theory
# that loads them, as MathComp 2 does, whether anything uses them or not. No file of ours can have such a name: ours are below faultspace.
PRIMITIVE = re.compile(r"Coq\.(?:Numbers\.Cyclic\.Int63\.PrimInt63|Strings\.PrimString)\.\w+")


def recheck(progress: Progress = silent) -> str:
    """Return what was done, in words. Raises NoRocq, BrokenTheory, NotProved: before Rocq sees what is not as locked, too."""
    held(texts := sources())
    forget(texts)
    theory = compiled_theory(progress, texts=texts)
    if shutil.which("coqchk") is None:
        return "compiled anew; coqchk is not on the path, so that Rocq's kernel alone has read it"
    progress("Rocq: reading the theory again with coqchk", 0, 1)
    second_check(theory)
    return "compiled anew, and read again by coqchk, with MathComp below it"


def second_check(theory: Path, seconds: float = SECONDS) -> None:
    """Has coqchk read all compiled files of this folder. Raises NotProved where it does not accept them as resting on nothing."""
    path = shutil.which("coqchk")
    assert path is not None
    names = [f"faultspace.{one.stem}" for one in sorted(theory.glob("*.vo"))]
    command = [path, "-silent", "-o", "-Q", str(theory), "faultspace", *names]
    try:
        with tempfile.TemporaryDirectory() as home:  # without one it would take the folder in which it was started, and load from there
            run = subprocess.run(
                command,
                capture_output=True,
                text=True,
                check=False,
                timeout=seconds,
                env=environment(home),
                stdin=subprocess.DEVNULL,
                preexec_fn=ending_with_us(),
            )
    except subprocess.TimeoutExpired:
        raise NotProved(f"coqchk took more than {seconds:g} s") from None
    printed = run.stdout + run.stderr  # with -silent the summary goes to standard error
    if run.returncode != 0:
        raise NotProved(f"coqchk does not accept the theory: {' '.join(printed.split())[-600:]}")
    for heading in HEADINGS:
        listed = re.search(rf"\* {re.escape(heading)}:(.*?)(?:\n\s*\*|\Z)", printed, re.DOTALL)
        names = listed[1].split() if listed else []
        rests = [one for one in names if heading != AXIOMS or not PRIMITIVE.fullmatch(one)]
        if not names or rests not in ([], ["<none>"]):
            raise NotProved(f"coqchk: {heading}: {' '.join(rests)[:300] or 'nothing was printed'}")
