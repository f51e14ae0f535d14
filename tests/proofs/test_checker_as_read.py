"""The checker is what its files say: what Python keeps of them compiled is believed in no way of running it."""

from __future__ import annotations

import importlib.util
import json
import os
import py_compile
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import faultspace
from tests.proofs.examples import HINTED, spoiled

FILES = ("checker", "checker_fields", "checker_structure", "checker_limits")  # each needs those before it
FALSE = spoiled(HINTED, ("witness.prime", 4))
FORGED = "\nimport sys\nsys.stderr.write('FORGED')\nrequire = expect = lambda *_, **__: None\n"  # so that whatever is asked is granted


def forged(file: Path) -> None:
    """Plants compiled files of another source beside a source, with its time and size, for Python with and without -O."""
    true, times = file.read_bytes(), file.stat()
    other = file.with_name("forged.py")
    other.write_bytes(true.replace(b'if __name__ == "__main__"', FORGED.encode() + b'\nif __name__ == "__main__"'))
    for optimised in (0, 1, 2):
        kept = Path(importlib.util.cache_from_source(str(file), optimization=optimised or ""))
        py_compile.compile(str(other), cfile=str(kept), dfile=str(file), optimize=optimised, doraise=True)
        data = bytearray(kept.read_bytes())
        data[8:16] = b"".join((number & 0xFFFFFFFF).to_bytes(4, "little") for number in (int(times.st_mtime), times.st_size))
        kept.write_bytes(data)
    other.unlink()


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Provides a folder with the package, the checker's files beside it, and a certificate that is none; all compiled files are forged, and
    in the package there is a forged folder beside each file."""
    place = tmp_path_factory.mktemp("forged")
    package = shutil.copytree(Path(faultspace.__file__).parent, place / "faultspace", ignore=shutil.ignore_patterns("__pycache__", "*.v"))
    for name in FILES:
        shutil.copy(package / "proofs" / "trust" / f"{name}.py", place)
        forged(place / f"{name}.py")
        source = package / "proofs" / "trust" / f"{name}.py"
        forged(source)
        source.with_suffix("").mkdir()  # a package, which Python prefers to the file beside it
        source.with_suffix("").joinpath("__init__.py").write_text(source.read_text("utf-8") + FORGED, "utf-8")
    (place / "false.json").write_text(json.dumps(FALSE), "utf-8")
    return place


PACKAGE = "import sys; from faultspace.proofs.trust import {} as one; sys.exit(getattr(one, 'core', one).main(['false.json']))"
MODULE = "faultspace.proofs.trust."


@pytest.mark.parametrize(
    "command",
    [[*flags, f"{name}.py"] for name in FILES for flags in (["-I", "-O"], ["-I"], ["-OO"])]
    + [["-m", MODULE + name] for name in FILES]
    + [["-c", PACKAGE.format(name), ""] for name in FILES]
    + [["-O", "-m", "faultspace", "check"]],
    ids=lambda command: " ".join(command)[:60],
)
def test_forged_compiled_files_are_not_believed(folder: Path, command: list[str]) -> None:
    arguments = [] if command[-1] == "" else ["false.json"]
    environment = {**os.environ, "PYTHONPATH": str(folder)}
    command = [sys.executable, *(part for part in command if part), *arguments]
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 1 and "FORGED" not in done.stderr, (done.stdout, done.stderr)
    assert "4 is not a prime" in done.stdout


def test_the_forged_files_are_what_python_itself_believes(folder: Path) -> None:
    """So the test above would see it: whoever imports a copied file has Python's word for it, and nobody else's."""
    program = "import sys; sys.path.insert(0, ''); import checker; sys.exit(checker.main(['false.json']))"
    done = subprocess.run([sys.executable, "-c", program], cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0 and "FORGED" in done.stderr
    program = "import sys; sys.path.insert(0, ''); import checker_fields as one; print(vars(sys.modules['checker'])['require'])"
    done = subprocess.run([sys.executable, "-c", program], cwd=folder, capture_output=True, text=True, check=False)
    assert "<function require" in done.stdout
