"""Files made to hang, to fill memory or disk, or to break a library get one line before any long computation.

Numbers of options that no machine can follow do, too.
"""

from __future__ import annotations

import io
import os
import zipfile
import zlib
from pathlib import Path

import numpy as np
import pytest
import scipy.io

from faultspace.base.errors import InvalidInput
from faultspace.numeric.data import damage
from tests.end_to_end.commands import Run, call
from tests.end_to_end.test_bad_input import refused


def identified(path: Path, *, inputs: str = "u", outputs: str = "y") -> Run:
    """Return the run of `identify` on the file, into a folder beside it."""
    return call("identify", str(path), "--inputs", inputs, "--outputs", outputs, "--out", str(path.parent / "answer"))


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="named pipes are those of POSIX")
@pytest.mark.parametrize("name", ["pipe.csv", "pipe.npz", "pipe.mat", "pipe.json", "pipe.toml"])
def test_a_pipe_that_nobody_writes_into_is_refused(tmp_path: Path, name: str) -> None:
    path = tmp_path / name
    os.mkfifo(path)
    if path.suffix == ".json":
        lines = [["inspect"], ["limit"], ["compare", "example:zeros"], ["monitor"], ["claim", "example:claims", "--explain"]]
        for line in lines:
            refused(call(*line, str(path)), name, "a pipe or a device")
        assert call("check", str(path)).code == 2
    elif path.suffix == ".toml":
        refused(call("claim", str(path)), name, "a pipe or a device")
    else:
        refused(identified(path), name, "a pipe or a device", "data file")


def test_names_longer_than_a_field_may_be(tmp_path: Path) -> None:
    path = tmp_path / "names.csv"
    path.write_text("u," + "y" * 200_000 + "\n" + "1,2\n3,4\n" * 30)
    refused(identified(path), "names.csv", "more than 131072 characters", "u,yyy")


@pytest.mark.parametrize("cut", [1, 3, 2001])
def test_a_table_in_utf_16_that_is_cut_within_a_character(tmp_path: Path, cut: int) -> None:
    path = tmp_path / "cut.csv"
    path.write_bytes(("u,y\n" + "1,2\n3,4\n" * 400).encode("utf-16")[:-cut])
    refused(identified(path), "cut.csv", "UTF-16", "is the file cut?")


def test_bytes_that_are_no_text_late_in_a_table(tmp_path: Path) -> None:
    path = tmp_path / "late.csv"
    path.write_bytes(b"u,y\n" + b"1,2\n" * 40_000 + b"1,\xff\xfe2\n" + b"1,2\n")
    refused(identified(path), "late.csv", "line 40002", "column 'y'")


@pytest.mark.parametrize("place", [0.3, 0.5, 0.7, 0.9])
def test_records_of_matlab_whose_packed_bytes_are_damaged(tmp_path: Path, place: float) -> None:
    signal = np.random.default_rng(0).standard_normal((500, 1))
    stream = io.BytesIO()
    scipy.io.savemat(stream, {"u": signal, "y": signal + 1}, do_compression=True)
    content = bytearray(stream.getvalue())
    content[int(place * len(content))] ^= 0xFF
    path = tmp_path / "packed.mat"
    path.write_bytes(bytes(content))
    refused(identified(path), "packed.mat", "MAT")


@pytest.mark.parametrize("harm", [b"(" * 40, b"'''", b"\x00" * 40, b"[[" * 20])
def test_the_head_of_an_array_that_is_damaged(tmp_path: Path, harm: bytes) -> None:
    stream = io.BytesIO()
    np.save(stream, np.ones((30, 3)))
    content = stream.getvalue()
    path = tmp_path / "array.npy"
    path.write_bytes(content[:10] + harm + content[10 + len(harm) :])
    refused(identified(path, inputs="data[:,0]", outputs="data[:,1:]"), "array.npy", "NPY")


def _bomb(path: Path, megabytes: int) -> None:
    """Write an archive with an array of zeros that unpacks to so many MiB."""
    head = io.BytesIO()
    np.lib.format.write_array_header_1_0(head, {"descr": "<f8", "fortran_order": False, "shape": (megabytes << 17, 1)})
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive, archive.open("u.npy", "w", force_zip64=True) as member:
        member.write(head.getvalue())
        for _ in range(megabytes):
            member.write(bytes(1 << 20))


def test_an_archive_of_one_value_is_not_unpacked(tmp_path: Path) -> None:
    path = tmp_path / "bomb.npz"
    _bomb(path, 64)
    refused(identified(path, inputs="u[:,0]", outputs="u"), "bomb.npz", "one value over and over")


def test_an_archive_for_which_there_is_no_room(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    signal = np.random.default_rng(0).standard_normal((1 << 18, 1))
    path = tmp_path / "large.npz"
    np.savez_compressed(path, u=signal, y=signal)
    monkeypatch.setattr("faultspace.numeric.data.files.shutil.disk_usage", lambda _: type("Usage", (), {"free": 1 << 20}))
    refused(identified(path), "large.npz", "the folder for temporary files", "expected a smaller file")


def test_a_record_of_matlab_that_memory_does_not_hold(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "large.mat"
    scipy.io.savemat(path, {"u": np.arange(3000.0)[:, None], "y": np.ones((3000, 1))})
    monkeypatch.setattr("faultspace.numeric.data.files.psutil.virtual_memory", lambda: type("Memory", (), {"available": 1000}))
    refused(identified(path), "large.mat", "memory", "expected a smaller file")


def test_an_array_of_hdf5_that_nobody_wrote(tmp_path: Path) -> None:
    h5py = pytest.importorskip("h5py", reason="MAT files of version 7.3 are read by h5py, which is not installed")
    path = tmp_path / "empty.mat"
    with h5py.File(path, "w", userblock_size=512) as file:
        for name in ("u", "y"):
            file.create_dataset(name, shape=(1, 10**14), chunks=(1, 1024), dtype="f8")  # no chunk of it is there
    with open(path, "r+b") as stream:
        stream.write(b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM")
    refused(identified(path), "empty.mat", "memory", "expected a smaller file")


def test_what_deflate_can_pack_at_most() -> None:
    """The bound is that of the format: a long run of zeros comes near it, and nothing passes it."""
    size = 1 << 26
    packed = len(zlib.compress(bytes(size), 9))
    assert damage.RUN < size / packed <= damage.DEFLATE_MOST
    damage.unpacks_to(damage.RUN * 1000, 1000, 10**9, "memory")
    with pytest.raises(InvalidInput, match="one value over and over"):
        damage.unpacks_to(damage.RUN * 1000 + 1, 1000, 10**9, "memory")


def test_an_error_of_ours_is_no_complaint_about_a_file() -> None:
    for error in (OSError("gone"), MemoryError(), InvalidInput("said")):
        with pytest.raises(type(error)), damage.from_library("NPY", "an array"):
            raise error
    with (
        pytest.raises(InvalidInput, match=r"cannot be read as NPY data \(KeyError\), expected an array"),
        damage.from_library("NPY", "an array"),
    ):
        raise KeyError


@pytest.mark.parametrize(
    ("line", "parts"),
    [
        (["audit", "faultspace.numeric.audit.reference", "--memory", "inf"], ("--memory", "'inf'")),
        (["audit", "faultspace.numeric.audit.reference", "--memory", "1e30"], ("--memory", "at most")),
        (["audit", "faultspace.numeric.audit.reference", "--timeout", "1e300"], ("--timeout", "at most")),
        (["verify", "--jobs", "99999999999"], ("--jobs", "1024 at most")),
        (["claim", "example:claims", "--jobs", "99999999999"], ("--jobs", "1024 at most")),
        (["conjecture", "lag", "--jobs", "99999999999"], ("--jobs", "1024 at most")),
        (["monte-carlo", "--out", "x", "--jobs", "99999999999"], ("--jobs", "1024 at most")),
        (["monte-carlo", "--out", "x", "--samples", "1"], ("samples", "2 or more")),
        (["identify", "x.csv", "--order", "1e12"], ("--order", "'1e12'", "whole number")),
        (["identify", "x.csv", "--noise-level", "inf"], ("--noise-level", "'inf'")),
    ],
    ids=lambda one: " ".join(one) if isinstance(one, list) else "",
)
def test_numbers_that_no_machine_can_follow(
    line: list[str], parts: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    refused(call(*line), *parts)


def test_records_of_next_to_nothing(tmp_path: Path) -> None:
    for name, values in {
        "row": np.ones((1, 2)),
        "denormal": np.full((50, 2), 5e-324),
        "empty": np.ones((0, 2)),
        "thin": np.ones((50, 0)),
    }.items():
        path = tmp_path / f"{name}.npy"
        np.save(path, values)
        refused(identified(path, inputs="data[:,0]", outputs="data[:,1]"), f"{name}.npy")


@pytest.mark.parametrize("kind", ["external link", "soft link through one", "virtual dataset", "external storage"])
def test_hdf5_that_has_its_numbers_in_other_files(kind: str, tmp_path: Path) -> None:
    h5py = pytest.importorskip("h5py")
    rows = np.random.default_rng(1).standard_normal((2, 400))
    with h5py.File(tmp_path / "secret.mat", "w") as file:
        file["y"] = rows
    (tmp_path / "raw").write_bytes(rows.tobytes())
    with h5py.File(tmp_path / "data.mat", "w", userblock_size=512) as file:
        file["u"] = rows[:1]
        if kind == "external link":
            file["y"] = h5py.ExternalLink("secret.mat", "y")
        elif kind == "soft link through one":
            file["z"], file["y"] = h5py.ExternalLink("secret.mat", "/"), h5py.SoftLink("/z/y")
        elif kind == "virtual dataset":
            layout = h5py.VirtualLayout((2, 400), "f8")
            layout[:] = h5py.VirtualSource("secret.mat", "y", (2, 400))
            file.create_virtual_dataset("y", layout)
        else:
            file.create_dataset("y", (2, 400), "f8", external=[("raw", 0, rows.nbytes)])
    with open(tmp_path / "data.mat", "r+b") as stream:
        stream.write(b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM")
    refused(identified(tmp_path / "data.mat"), "may be in another file", "expected a MAT file as MATLAB saves it")
