"""What a result depends on beside the implementation: by these it can be made again."""

from __future__ import annotations

import hashlib
import platform
from functools import cache
from importlib import metadata
from importlib.resources import files
from typing import Any

import numpy
import scipy
from threadpoolctl import threadpool_info

from ....base.threads import one_thread
from ..vectors.shipped_vectors import FORMAT


@cache
def vectors_digest() -> str:
    """Return the SHA-256 digest over the names and contents of all files of the vectors, in the order of their names."""
    digest = hashlib.sha256()
    for file in sorted(files("faultspace.numeric.audit.vectors").joinpath("data").iterdir(), key=lambda one: one.name):
        if file.name.endswith(".json"):
            digest.update(file.name.encode() + b"\0" + file.read_bytes() + b"\0")
    return digest.hexdigest()


def kit() -> str:
    """Return the version of faultspace that is installed."""
    try:
        return metadata.version("faultspace")
    except metadata.PackageNotFoundError:  # read from a tree that nobody installed
        return "unknown"


@one_thread()
def versions() -> dict[str, Any]:
    """Return the versions of the kit, its vectors, Python, numpy, scipy and BLAS, and the platform, ready for JSON."""
    libraries = [
        {name: one.get(name) for name in ("internal_api", "version", "architecture")}
        for one in threadpool_info()
        if one["user_api"] == "blas"
    ]
    return {
        "faultspace": kit(),
        "vectors": {"format": FORMAT, "sha256": vectors_digest()},
        "python": f"{platform.python_implementation()} {platform.python_version()}",
        "numpy": numpy.__version__,
        "scipy": scipy.__version__,
        "blas": libraries,
        "platform": platform.platform(),
    }
