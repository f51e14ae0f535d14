"""The page as PDF, printed by a Chromium of the machine's own.

browser     the path of one; raises InvalidInput where there is none, and says what was looked for
print_page  prints a page into a file
packed      the file made smaller, where pikepdf is installed
"""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from pathlib import Path

from ..base.errors import InvalidData, InvalidInput, quote_path
from ..base.writing import whole_file

ELSEWHERE = "leave --pdf out, and print the page in any browser"
NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome", "microsoft-edge")
PATIENCE = 180  # seconds that printing may take; a page of a whole run takes some ten


def browser() -> str:
    """Return the first of NAMES that is on the path."""
    found = next((path for name in NAMES if (path := shutil.which(name)) is not None), None)
    if found is None:
        raise InvalidInput(f"pdf: got no Chromium, expected one of {', '.join(NAMES)} on the PATH; any browser prints the page, too")
    return found


def print_page(page: Path, pdf: Path) -> None:
    """Print the page into the file `pdf`. Raises InvalidInput where there is no Chromium, InvalidData where it fails."""
    program = browser()
    with tempfile.TemporaryDirectory(prefix="faultspace-") as profile:
        printed = Path(profile) / "page.pdf"
        command = [program, "--headless", "--disable-gpu", "--no-first-run", "--no-pdf-header-footer", f"--user-data-dir={profile}"]
        if hasattr(os, "geteuid") and os.geteuid() == 0:  # Chromium refuses its sandbox to the superuser
            command.append("--no-sandbox")
        try:
            done = subprocess.run(
                [*command, f"--print-to-pdf={printed}", page.resolve().as_uri()],
                capture_output=True,
                text=True,
                timeout=PATIENCE,
                check=False,
            )
        except (OSError, subprocess.TimeoutExpired) as error:
            raise InvalidData(f"{quote_path(str(pdf))}: {program} did not print the page ({error}); {ELSEWHERE}") from None
        if not printed.exists():
            said = " ".join(done.stderr.split())[-300:]
            raise InvalidData(
                f"{quote_path(str(pdf))}: {program} did not print the page ({said or f'it ended with code {done.returncode}'}); {ELSEWHERE}"
            )
        packed(printed)
        with whole_file(pdf) as stream:
            stream.write(printed.read_bytes())


def packed(pdf: Path) -> None:
    """Write the file anew with its objects compressed, to a third of its size: Chromium writes the tags, by which it can be read aloud, as
    plain text. Without pikepdf the file stays as it is."""
    try:
        from pikepdf import ObjectStreamMode, Pdf
    except ImportError:
        return
    with Pdf.open(pdf, allow_overwriting_input=True) as document:
        document.save(pdf, object_stream_mode=ObjectStreamMode.generate)
