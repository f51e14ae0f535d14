"""Without the extras each command that needs one says which, and the others answer. This needs pytest alone, and so runs without any."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

# What the extras bring, which looks as if it were not installed, whether it is or not.
ABSENT = (
    "matplotlib",
    "pyarrow",
    "h5py",
    "distributed",
    "dask",
    "control",
    "ctrlsys",
    "sippy_unipi",
    "nfoursid",
    "cypari",
    "jsonschema",
    "jinja2",
    "markupsafe",
    "pandas",
)
WITHOUT = f"""
import sys
from importlib import metadata

def version(name, known=metadata.version):
    if name in {ABSENT!r}:
        raise metadata.PackageNotFoundError(name)
    return known(name)

metadata.version = version
sys.modules.update(dict.fromkeys({ABSENT!r}))
from faultspace.cli.command_line import main
codes = {{main(line.split()) for line in sys.argv[1:]}}
sys.exit(codes.pop() if len(codes) == 1 else 99)
"""

PROGRESS = re.compile(r"faultspace: .*( \.\.\.| \(\d+ of \d+.*\))")


def without(*lines: str) -> tuple[int, list[str]]:
    """Return the exit code of each of these command lines without any extra (99: not the same), and what they said."""
    done = subprocess.run([sys.executable, "-c", WITHOUT, *lines], capture_output=True, text=True, timeout=400, check=False)
    return done.returncode, [line for line in done.stderr.splitlines() if not PROGRESS.fullmatch(line)]


def test_a_command_that_needs_an_extra_says_which(tmp_path: Path) -> None:
    channels = f"--inputs u --outputs y --out {tmp_path / 'out'}"
    parquet, mat = tmp_path / "data.parquet", tmp_path / "data.mat"
    parquet.write_bytes(b"PAR1" + bytes(100) + b"PAR1")
    mat.write_bytes(b"MATLAB 7.3 MAT-file".ljust(116) + bytes(8) + b"\0\2IM" + bytes(384) + b"\x89HDF\r\n\x1a\n" + bytes(100))
    asked = {
        f"identify {parquet} {channels}": "faultspace[parquet]",
        f"identify {mat} {channels}": "faultspace[mat73]",
        f"monte-carlo --systems 2 --scheduler tcp://127.0.0.1:9 --out {tmp_path / 'study'}": "faultspace[cluster]",
        "audit --peer nfoursid": "needed is: pip install nfoursid",
        f"report --out {tmp_path / 'page'}": "faultspace[report]",
    }
    code, said = without(*asked)
    assert code == 2 and len(said) == len(asked), said
    for line, words in zip(said, asked.values(), strict=True):
        assert words in line


def test_the_others_answer_and_pictures_that_are_left_out_are_named_with_their_extra(tmp_path: Path) -> None:
    study = f"monte-carlo --systems 2 --samples 30 --jobs 1 --out {tmp_path / 'study'}"
    code, said = without(study, "inspect example:zeros", "compare example:zeros example:zeros", "examples", "audit --list", "--help")
    assert code == 0 and any("faultspace[plots]" in line for line in said)
    assert not list((tmp_path / "study").glob("*.png")) and (tmp_path / "study" / "cases.csv").exists()
