"""The addresses outside the tree that pages lead to: where there is a network, each has to answer.

    python -m tests.house.test_addresses    prints them, each with the pages that name it

ADDRESSES    address -> the files of the tree that name it
answered     what became of asking for one: "" where it answered, else why it is not known whether it would; raises Gone where it is gone
"""

from __future__ import annotations

import re
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, HTTPServer
from pathlib import Path
from urllib.error import HTTPError, URLError
from urllib.request import Request, urlopen

import pytest

ROOT = Path(__file__).parents[2]
FOLDERS = ("docs", "proofs", "numeric", "benchmarks", "faultspace", "exact")
ADDRESS = re.compile(r"https?://[^\s)\]>\"'`<|{}]+|arXiv:\d{4}\.\d{4,5}")
NO_PLACES = ("http://www.w3.org/", "http://127.0.0.1", "https://json-schema.org/draft")  # names of formats, and this machine
SECONDS = 20.0


class Gone(Exception):
    """The host answers that there is no such page."""


def read() -> dict[str, list[str]]:
    named = [*ROOT.glob("*.md"), ROOT / "CITATION.cff", ROOT / "pyproject.toml"]
    named += [path for folder in FOLDERS for ending in ("md", "html", "toml", "opam") for path in (ROOT / folder).rglob(f"*.{ending}")]
    found: dict[str, list[str]] = {}
    for path in sorted(set(named)):
        for address in ADDRESS.findall(path.read_text("utf-8")):
            address = address.rstrip(".,;:").replace("arXiv:", "https://arxiv.org/abs/")
            if not address.startswith(NO_PLACES):
                found.setdefault(address, []).append(path.relative_to(ROOT).as_posix())
    return found


ADDRESSES = read()


def answered(address: str) -> str:
    """Return "" for an address that answered, and else in words why that is not known. Raises Gone for 404 and 410."""
    try:
        with urlopen(Request(address, headers={"User-Agent": "Mozilla/5.0 (a test of links)"}), timeout=SECONDS) as answer:
            answer.read(1)
        return ""
    except HTTPError as error:
        if error.code in (404, 410):
            raise Gone(f"{address}: {error.code}") from None
        return f"{address}: the host answers programs with {error.code}"
    except (URLError, OSError) as error:
        return f"{address}: the network does not reach it ({error})"


def test_addresses_are_found_and_are_safe() -> None:
    assert "https://arxiv.org/abs/2505.13294" in ADDRESSES and len(ADDRESSES) >= 3
    assert [one for one in ADDRESSES if not one.startswith("https://")] == []


@contextmanager
def host(code: int) -> Iterator[str]:
    """A host on this machine that answers everything with this code."""

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            self.send_response(code)
            self.end_headers()

        def log_message(self, format: str, *arguments: object) -> None:
            """Standard error is for what went wrong."""

    with HTTPServer(("127.0.0.1", 0), Handler) as server:
        thread = threading.Thread(target=server.serve_forever, daemon=True)
        thread.start()
        yield f"http://127.0.0.1:{server.server_address[1]}/page"
        server.shutdown()
        thread.join()


def test_what_is_gone_is_told_from_what_cannot_be_asked() -> None:
    with host(200) as address:
        assert answered(address) == ""
    assert "does not reach it" in answered(address), "nobody listens there any more"
    with host(403) as address:
        assert answered(address).endswith("the host answers programs with 403")
    for code in (404, 410):
        with host(code) as address, pytest.raises(Gone, match=str(code)):
            answered(address)


@pytest.mark.slow
def test_every_address_answers() -> None:
    gone, unasked = [], []
    for address, files in sorted(ADDRESSES.items()):
        try:
            unasked += [reason] if (reason := answered(address)) else []
        except Gone as found:
            gone.append(f"{found}; it is named in {', '.join(sorted(set(files)))}")
    assert gone == []
    if unasked:
        pytest.skip("; ".join(unasked))


if __name__ == "__main__":
    for one, files in sorted(ADDRESSES.items()):
        print(one, *sorted(set(files)), sep="\n    ")
