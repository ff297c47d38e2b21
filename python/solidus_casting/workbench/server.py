"""The server of the page: on the loopback address alone, behind a random token, for pages of its own origin.

A request is answered only if its Host is that address, its path begins with the token, and a browser that names the page it
comes from names ours. All else gets 404, as if nothing were there.
"""

from __future__ import annotations

import hmac
import json
import secrets
import shutil
import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, unquote, urlsplit

from .. import verbs
from ..errors import InputError, SolidusError
from . import library
from .bench import Bench
from .choices import PROCESSES, RISERS, ROLES
from .job import Conflict

_PAGE = Path(__file__).with_name("page.html")
_MOST_REQUEST = 8_000_000  # bytes of a request in JSON
_MOST_UPLOAD = 1_000_000_000  # bytes of a part
_LONGEST_WAIT = 20.0  # seconds for a change of the state
_HTML = "text/html; charset=utf-8"


class Server:
    """The page of a folder at :attr:`address`.

    Attributes
    ----------
    address:
        With the token, which other users of the machine do not know.
    bench:
        What the page shows and does.
    """

    def __init__(self, folder: Path) -> None:
        self.token = secrets.token_hex(16)
        self._http = _Http(self)
        self.port = self._http.server_address[1]
        self.address = f"http://127.0.0.1:{self.port}/{self.token}/"
        self.bench = Bench(folder, self.address)

    @property
    def hosts(self) -> tuple[str, str]:
        return f"127.0.0.1:{self.port}", f"localhost:{self.port}"

    def serve(self) -> None:
        """Answers until :meth:`close` is called from another thread, or Ctrl-C."""
        self._http.serve_forever(poll_interval=0.2)

    def close(self) -> None:
        threading.Thread(target=self._http.shutdown, daemon=True).start()
        self.bench.close()
        self._http.server_close()


class _Http(ThreadingHTTPServer):
    daemon_threads = True
    allow_reuse_address = False
    block_on_close = False

    def __init__(self, server: Server) -> None:
        self.workbench = server
        super().__init__(("127.0.0.1", 0), _Request)


class _Request(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    server_version, sys_version = "Solidus", ""
    timeout = 60
    server: _Http

    def log_message(self, format: str, *args: Any) -> None:
        """Nothing: an address holds the token."""

    # Who may ask

    def _way(self) -> tuple[str, dict[str, str]] | None:
        """What is asked for behind the token, and the parameters; nothing where that may not be asked."""
        workbench = self.server.workbench
        if self.headers.get("Host", "") not in workbench.hosts or not self._of_own_page():
            return None
        url = urlsplit(self.path)
        _, token, way = [*url.path.split("/", 2), "", ""][:3]
        if not hmac.compare_digest(token.encode(errors="replace"), workbench.token.encode()):
            return None
        return unquote(way), {name: values[0] for name, values in parse_qs(url.query).items()}

    def _of_own_page(self) -> bool:
        """Whether the page that asks, as far as the browser names it, is ours. What changes anything has to be named."""
        origins = [f"http://{host}" for host in self.server.workbench.hosts]
        origin, site = self.headers.get("Origin"), self.headers.get("Sec-Fetch-Site", "none")
        if site not in ("none", "same-origin") or (origin is not None and origin not in origins):
            return False
        return self.command == "GET" or origin is not None

    # Requests

    def do_GET(self) -> None:
        asked = self._way()
        if asked is None:
            return self._send(404, b"there is nothing here\n")
        try:
            self._get(*asked)
        except SolidusError as error:
            self._refuse(error)
        except OSError:
            self._send(404, b"there is nothing here\n")

    def _get(self, way: str, given: dict[str, str]) -> None:
        bench = self.server.workbench.bench
        if way == "":
            self._send(200, _PAGE.read_bytes(), _HTML)
        elif way == "state":
            known = int(given.get("known", "0")) if given.get("known", "0").isdigit() else 0
            self._json(bench.state(known, _LONGEST_WAIT if known else 0.0))
        elif way == "about":
            self._json({"version": verbs.version(), "materials": library.materials(), "processes": PROCESSES, "roles": ROLES, "risers": RISERS})
        elif way == "schema":
            self._send(200, verbs.cached("schema").encode(), "application/json")
        elif way == "material":
            self._json({"text": library.card(given.get("name", ""))})
        elif way == "files":
            self._json(bench.files())
        elif way in ("skin/part", "skin/case"):
            self._send(200, bench.picture(way.partition("/")[2]), "application/octet-stream")
        elif way == "curves":
            self._json(bench.curves(given.get("run", "")))
        else:
            self._get_page(way, bench)

    def _get_page(self, way: str, bench: Bench) -> None:
        """Reports, which are pages of their own with a policy of their own; `stamp` tells them that there is no newer one."""
        first, _, rest = way.partition("/")
        name, _, last = rest.rpartition("/")
        if last == "stamp" and first in ("run", "compared"):
            self._send(200, b"")
        elif first == "run" and last == "report":
            self._send(200, bench.report(name).read_bytes(), _HTML)
        elif first == "run" and last == "printed":
            pages = bench.printed(name)
            self._send(200, pages.read_bytes(), "application/pdf" if pages.suffix == ".pdf" else _HTML)
        elif way == "compared/report":
            self._send(200, bench.comparison().read_bytes(), _HTML)
        else:
            self._send(404, b"there is nothing here\n")

    def do_POST(self) -> None:
        asked = self._way()
        if asked is None:
            self.close_connection = True
            return self._send(404, b"there is nothing here\n")
        try:
            way, given = asked
            if way == "upload":
                self._upload(given.get("name", ""))
            else:
                self._do(way, self._request())
        except SolidusError as error:
            self._refuse(error)
        except OSError as error:
            self._refuse(InputError(f"{error.filename or 'a file'}: {error.strerror or error}"))

    def _request(self) -> dict[str, Any]:
        length = self.headers.get("Content-Length", "")
        if not length.isdigit() or int(length) > _MOST_REQUEST:
            self.close_connection = True
            raise InputError("this request has no length, or is too long")
        try:
            given = json.loads(self.rfile.read(int(length)) or b"{}")
        except (ValueError, RecursionError) as error:
            raise InputError(f"this request is no JSON: {error}") from error
        if not isinstance(given, dict):
            raise InputError("this request is no table")
        return given

    def _do(self, way: str, given: dict[str, Any]) -> None:
        bench = self.server.workbench.bench
        seen = given.get("seen") if isinstance(given.get("seen"), int) else -1
        actions = {
            "open": lambda: bench.open(str(given.get("name", ""))),
            "choose": lambda: bench.choose(seen, given.get("choices")),
            "text": lambda: bench.set_text(seen, given.get("text")),
            "set": lambda: bench.set_key(seen, given.get("path"), given.get("value")),
            "add": lambda: bench.add_sections(seen, given.get("sections")),
            "remove": lambda: bench.remove(seen, given["paths"] if "paths" in given else [given.get("path")]),
            "undo": lambda: bench.go(seen, -1),
            "redo": lambda: bench.go(seen, 1),
            "make": lambda: bench.make(seen),
            "preview": lambda: bench.make(seen, only_show=True),
            "check": bench.check,
            "run": lambda: bench.run(given.get("physics"), given.get("sure")),
            "compare": lambda: bench.compare(given.get("first"), given.get("second")),
            "print": lambda: bench.print(given.get("run")),
            "stop": bench.stop,
        }
        if way not in actions:
            return self._send(404, b"there is nothing here\n")
        actions[way]()
        self._json(bench.state())

    def _upload(self, name: str) -> None:
        """A part that was dropped on the page goes into the folder, whole or not at all, and is opened."""
        bench = self.server.workbench.bench
        length = self.headers.get("Content-Length", "")
        self.close_connection = True  # what is left of a refused file is not read
        if not length.isdigit() or not 0 < int(length) <= _MOST_UPLOAD:
            raise InputError("this file is empty or too large", f"up to {_MOST_UPLOAD // 1_000_000} MB")
        bench.must_be_free()
        place = bench.place.place_of_upload(name)
        aside = place.with_name(f".{place.name}.new")
        try:
            with aside.open("wb") as file:
                left = int(length)
                while left:
                    block = self.rfile.read(min(left, 1 << 20))
                    if not block:
                        raise InputError("the file did not arrive whole", "the same file again")
                    file.write(block)
                    left -= len(block)
            shutil.move(aside, place)
        finally:
            aside.unlink(missing_ok=True)
        bench.open(place.name)
        self._json(bench.state())

    # Answers

    def _refuse(self, error: SolidusError) -> None:
        self._json({"error": str(error)}, 409 if isinstance(error, Conflict) else 400)

    def _json(self, answer: Any, status: int = 200) -> None:
        self._send(status, json.dumps(answer, default=str).encode(), "application/json")

    def _send(self, status: int, body: bytes, kind: str = "text/plain; charset=utf-8") -> None:
        self.send_response(status)
        for name, value in (("Content-Type", kind), ("Content-Length", str(len(body))), ("Cache-Control", "no-store"),
                            ("X-Content-Type-Options", "nosniff"), ("Referrer-Policy", "no-referrer"), ("X-Frame-Options", "SAMEORIGIN"),
                            ("Cross-Origin-Resource-Policy", "same-origin")):
            self.send_header(name, value)
        if self.close_connection:
            self.send_header("Connection", "close")
        self.end_headers()
        try:
            self.wfile.write(body)
        except (BrokenPipeError, ConnectionResetError):
            self.close_connection = True  # the page is gone
