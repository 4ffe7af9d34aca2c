"""A folder's files from a host like those that sites are on, and what Lighthouse says of a page there."""

from __future__ import annotations

import gzip
import json
import os
import re
import shutil
import subprocess
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from http import HTTPStatus
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from io import BytesIO
from pathlib import Path
from typing import Any, BinaryIO

from clinic.engine import node

LIGHTHOUSE = "node_modules/lighthouse/cli/index.js"
BROWSER = "--headless=new --no-sandbox --disable-gpu"


class Host(SimpleHTTPRequestHandler):
    """Answers as a host does: what is text goes compressed over the wire."""

    def send_head(self) -> BytesIO | BinaryIO | None:
        """The answer's head, and its body."""
        path = Path(self.translate_path(self.path))
        path = path / "index.html" if path.is_dir() else path
        kind = self.guess_type(str(path))
        if not (path.is_file() and re.search("text/|javascript|json|xml", kind)):
            return super().send_head()
        body = gzip.compress(path.read_bytes(), 6)
        self.send_response(HTTPStatus.OK)
        for name, value in {"Content-Type": kind, "Content-Encoding": "gzip", "Content-Length": len(body)}.items():
            self.send_header(name, str(value))
        self.end_headers()
        return BytesIO(body)

    def log_message(self, format: str, *args: object) -> None:
        """Says nothing."""


@contextmanager
def served(folder: Path) -> Iterator[str]:
    """The address of a folder's files."""
    with ThreadingHTTPServer(("127.0.0.1", 0), partial(Host, directory=str(folder))) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        try:
            yield f"http://127.0.0.1:{server.server_port}/"
        finally:
            server.shutdown()


def lighthouse(root: Path, address: str, *categories: str) -> dict[str, Any]:
    """What Lighthouse finds on a page, as on a telephone: `categories` with their scores from 0 to 1, and `audits`.

    Raises:
        RuntimeError: If it does not end well, with what it said.
    """
    browser = shutil.which("chromium") or shutil.which("google-chrome") or ""
    options = [f"--only-categories={','.join(categories)}", f"--chrome-flags={BROWSER}", "--no-enable-error-reporting"]
    command = [str(node.launcher()), str(root / LIGHTHOUSE), address, "--quiet", "--output=json", *options]
    environment = os.environ | {"CHROME_PATH": browser}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"Lighthouse did not end well on {address}: {done.stderr.strip()[-2000:]}")
    said: dict[str, Any] = json.loads(done.stdout)
    return said
