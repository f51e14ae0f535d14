"""A page on a local address, which this machine alone can reach.

serving   a server of one page, in the background as long as the context lasts; gives its address
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from threading import Thread

HOST = "127.0.0.1"
PLACES = ("/", "/report.html")


@contextmanager
def serving(page: str) -> Iterator[str]:
    """Serve the text of a page, at a port that the system chooses; every other address is not found."""
    content = page.encode("utf-8")

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:  # http.server's name
            found = self.path.partition("?")[0] in PLACES
            self.send_response(200 if found else 404)
            self.send_header("Content-Type", "text/html; charset=utf-8")
            self.send_header("Content-Length", str(len(content) if found else 0))
            self.end_headers()
            if found:
                self.wfile.write(content)

        def log_message(self, format: str, *arguments: object) -> None:
            """Standard error is for what went wrong."""

    with ThreadingHTTPServer((HOST, 0), Handler) as server:
        thread = Thread(target=server.serve_forever, daemon=True)
        thread.start()
        try:
            yield f"http://{HOST}:{server.server_address[1]}/"
        finally:
            server.shutdown()
            thread.join()
