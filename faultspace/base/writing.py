"""Files that are there whole or not at all.

write_text   a text into a file
reason       why the operating system refused, as the end of a sentence
"""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from .errors import InvalidInput, quote_path


def write_text(path: Path, text: str) -> None:
    """Write the text beside the file at `path` and rename it, so that no half-written file is ever seen there.

    Raises InvalidInput where that cannot be.
    """
    try:
        descriptor, temporary = tempfile.mkstemp(prefix=".unfinished-", dir=path.parent)
        try:
            with open(descriptor, "w", encoding="utf-8") as stream:
                stream.write(text)
            os.chmod(temporary, 0o644)
            os.replace(temporary, path)
        except BaseException:
            os.unlink(temporary)
            raise
    except OSError as error:
        raise InvalidInput(f"{quote_path(str(path))}: cannot be written ({reason(error)}), expected another path") from None


def reason(error: Exception) -> str:
    """Return what the operating system says of an error, or the error says of itself, with a small letter first."""
    text = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
    return text[:1].lower() + text[1:]
