"""The file of a saved monitor: written whole or not at all, and never over a file that is another."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

from ....base.errors import InvalidInput, in_file, quote_path
from ....base.regular_files import open_regular
from ....base.writing import write_text
from .learned import FORMAT

MODEL = "model.json"  # what `identify` calls it; a test compares the two
MOST = 1 << 26  # bytes of a file, as of all JSON that is read
HEAD = 200  # bytes of a file that is there already, in which its format stands


def write(path: str | os.PathLike[str], document: dict[str, Any]) -> None:
    """Write the document of a monitor. Raises InvalidInput where that cannot be, or where a file that is none is there already."""
    target = Path(path)
    refuse(target)
    text = json.dumps(document, allow_nan=False) + "\n"
    if len(text) > MOST:
        raise InvalidInput(f"{quote_path(str(path))}: the monitor takes {len(text)} bytes, expected at most {MOST}: give a shorter window")
    write_text(target, text)


def refuse(path: Path) -> None:
    """Raise InvalidInput where a file is there that is no saved monitor, or where there is no folder to write into: before a long watch."""
    if not path.parent.is_dir():
        raise InvalidInput(f"{quote_path(str(path))}: cannot be written (there is no such folder), expected another path")
    try:
        if not os.path.lexists(path):
            return
        with open_regular(path, "a saved monitor") as stream:
            if f'"format": "{FORMAT}"' in stream.read(HEAD).decode("utf-8", "replace"):
                return
    except (OSError, InvalidInput):
        pass
    raise InvalidInput(f"{quote_path(str(path))}: is there, and no saved monitor; it is left as it is: name another file")


def read(path: str | os.PathLike[str]) -> Any:
    """Return the document in the file. Raises InvalidInput where there is none in JSON."""
    source = Path(path)
    source = source / MODEL if source.is_dir() else source
    try:
        with in_file(str(source)), open_regular(source, "a saved monitor or a model") as stream:
            content = stream.read(MOST + 1)
            if len(content) > MOST:
                raise InvalidInput(f"got more than {MOST} bytes, expected at most that")
            return json.loads(content.decode("utf-8-sig"))
    except InvalidInput:
        raise
    except (ValueError, RecursionError):
        raise InvalidInput(f"{quote_path(str(source))}: got no JSON, expected a saved monitor or a model.json of identify") from None
