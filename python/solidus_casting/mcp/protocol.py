"""The Model Context Protocol over standard input and output: one message a line, JSON-RPC 2.0.

Requests are served on threads, so that a long run leaves the server ready for questions and for its own cancellation.
"""

from __future__ import annotations

import json
import logging
import threading
import time
from collections.abc import Callable, Mapping
from typing import Any, BinaryIO

from ..errors import SolidusError
from . import arguments as checks

logger = logging.getLogger("solidus_casting.mcp")

VERSIONS = ("2025-11-25", "2025-06-18")  # the newest first
_PARSE, _REQUEST, _METHOD, _PARAMETERS, _INTERNAL = -32700, -32600, -32601, -32602, -32603
_LONGEST_LINE = 1 << 20  # bytes of a message
_BETWEEN_PROGRESS = 0.25  # seconds
_MOST_JOBS = 32


class Cancelled(Exception):
    """The client has given up the request."""


class ProtocolError(Exception):
    """A request that is none, or that this server does not serve."""

    def __init__(self, code: int, message: str) -> None:
        super().__init__(message)
        self.code, self.message = code, message


class Job:
    """A request that is being served.

    Attributes
    ----------
    stop:
        Set when the client gives it up, or goes.
    """

    def __init__(self, server: "Server", identifier: Any, token: Any) -> None:
        self._server, self._identifier, self._token = server, identifier, token
        self._told, self._last = -1.0, 0.0
        self.stop = threading.Event()

    def progress(self, done: float, total: float | None, message: str) -> None:
        """Tells how far it is, where the client wants to know. Values that are no larger than the last one are passed over, and
        those that come too soon after it."""
        now = time.monotonic()
        if self._token is None or self.stop.is_set() or done <= self._told or now - self._last < _BETWEEN_PROGRESS:
            return
        self._told, self._last = done, now
        known = {} if total is None else {"total": total}
        self._server.send({"method": "notifications/progress",
                           "params": {"progressToken": self._token, "progress": done, **known, "message": message}})

    def raise_if_stopped(self) -> None:
        if self.stop.is_set():
            raise Cancelled


class Server:
    """Serves one client until its input ends.

    Parameters
    ----------
    tools:
        The tools, see :class:`.tools.Tool`.
    information:
        ``serverInfo`` of the answer to ``initialize``.
    instructions:
        What an assistant should know of all tools together.
    """

    def __init__(self, tools: list[Any], information: Mapping[str, str], instructions: str, output: BinaryIO) -> None:
        self._tools = {tool.name: tool for tool in tools}
        self._information, self._instructions, self._output = dict(information), instructions, output
        self._jobs: dict[Any, Job] = {}
        self._lock = threading.Lock()  # of the jobs
        self._writing = threading.Lock()
        self._started = False

    # Messages

    def serve(self, source: BinaryIO) -> None:
        """Reads and answers until the input ends; what still runs then is stopped."""
        try:
            while line := source.readline(_LONGEST_LINE + 1):
                if len(line) > _LONGEST_LINE:
                    while line and not line.endswith(b"\n"):
                        line = source.readline(_LONGEST_LINE)
                    self._fail(None, ProtocolError(_REQUEST, f"a message has at most {_LONGEST_LINE} bytes"))
                elif line.strip():
                    self._receive(line)
        finally:
            self.stop()

    def stop(self) -> None:
        """Stops all that runs and waits for it."""
        with self._lock:
            jobs = list(self._jobs.values())
        for job in jobs:
            job.stop.set()
        for thread in threading.enumerate():
            if thread.name.startswith("request "):
                thread.join()

    def send(self, message: Mapping[str, Any]) -> None:
        line = json.dumps({"jsonrpc": "2.0", **message}, ensure_ascii=False, allow_nan=False) + "\n"
        with self._writing:
            try:
                self._output.write(line.encode("utf-8", "replace"))
                self._output.flush()
            except (BrokenPipeError, ValueError):
                pass  # the client has gone; the end of its input tells

    def _fail(self, identifier: Any, error: ProtocolError) -> None:
        self.send({"id": identifier, "error": {"code": error.code, "message": error.message}})

    def _receive(self, line: bytes) -> None:
        try:
            message = json.loads(line)
        except (ValueError, RecursionError) as error:
            self._fail(None, ProtocolError(_PARSE, f"this is no JSON: {error}"))
            return
        if not isinstance(message, dict) or message.get("jsonrpc") != "2.0":
            self._fail(None, ProtocolError(_REQUEST, "a message is one object of JSON-RPC 2.0; there are no batches"))
            return
        identifier, method, parameters = message.get("id"), message.get("method"), message.get("params", {})
        if method is None:
            return  # an answer, and nothing was asked
        if "id" not in message:
            self._notified(method, parameters)
            return
        try:
            if isinstance(identifier, bool) or not isinstance(identifier, (str, int)) or not isinstance(method, str):
                raise ProtocolError(_REQUEST, "a request has a method, a text, and an id, a text or an integer")
            if not isinstance(parameters, dict):
                raise ProtocolError(_PARAMETERS, "params is an object")
            self._requested(identifier, method, parameters)
        except ProtocolError as error:
            self._fail(identifier if isinstance(identifier, (str, int)) else None, error)

    def _notified(self, method: Any, parameters: Any) -> None:
        if method == "notifications/cancelled" and isinstance(parameters, dict):
            identifier = parameters.get("requestId")
            if isinstance(identifier, (str, int)):
                with self._lock:
                    job = self._jobs.get(identifier)
                if job is not None:
                    logger.info("request %s is cancelled: %s", identifier, parameters.get("reason", "no reason given"))
                    job.stop.set()

    # Requests

    def _requested(self, identifier: Any, method: str, parameters: dict[str, Any]) -> None:
        if method == "ping":
            self.send({"id": identifier, "result": {}})
        elif method == "initialize":
            self.send({"id": identifier, "result": self._initialize(parameters)})
        elif not self._started:
            raise ProtocolError(_REQUEST, f"'{method}' before 'initialize'")
        elif method == "tools/list":
            if "cursor" in parameters:
                raise ProtocolError(_PARAMETERS, "there is no such cursor: all tools are on one page")
            self.send({"id": identifier, "result": {"tools": [tool.declaration() for tool in self._tools.values()]}})
        elif method == "tools/call":
            self._call(identifier, parameters)
        else:
            raise ProtocolError(_METHOD, f"there is no method '{method}' here: initialize, ping, tools/list, tools/call")

    def _initialize(self, parameters: dict[str, Any]) -> dict[str, Any]:
        if self._started:
            raise ProtocolError(_REQUEST, "a session is initialized once")
        asked = parameters.get("protocolVersion")
        if not isinstance(asked, str):
            raise ProtocolError(_PARAMETERS, "protocolVersion is missing; served are " + ", ".join(VERSIONS))
        self._started = True
        return {"protocolVersion": asked if asked in VERSIONS else VERSIONS[0], "capabilities": {"tools": {}},
                "serverInfo": self._information, "instructions": self._instructions}

    def _call(self, identifier: Any, parameters: dict[str, Any]) -> None:
        tool = self._tools.get(parameters.get("name")) if isinstance(parameters.get("name"), str) else None
        if tool is None:
            raise ProtocolError(_PARAMETERS, f"there is no tool {parameters.get('name')!r}; one of: {', '.join(self._tools)}")
        given, meta = parameters.get("arguments", {}), parameters.get("_meta", {})
        if not isinstance(given, dict) or not isinstance(meta, dict):
            raise ProtocolError(_PARAMETERS, "arguments and _meta are objects")
        token = meta.get("progressToken")
        if token is not None and (isinstance(token, bool) or not isinstance(token, (str, int))):
            raise ProtocolError(_PARAMETERS, "progressToken is a text or an integer")
        job = Job(self, identifier, token)
        with self._lock:
            if identifier in self._jobs:
                raise ProtocolError(_REQUEST, f"a request with the id {identifier!r} is being served")
            if len(self._jobs) >= _MOST_JOBS:
                raise ProtocolError(_REQUEST, f"{_MOST_JOBS} requests wait already")
            self._jobs[identifier] = job
        threading.Thread(target=self._serve_call, args=(identifier, tool, given, job), name=f"request {identifier}").start()

    def _serve_call(self, identifier: Any, tool: Any, given: dict[str, Any], job: Job) -> None:
        answer: dict[str, Any] | None
        try:
            answer = {"result": result_of(tool, given, job)}
        except Cancelled:
            answer = None
        except Exception as error:  # a mistake of the server: the client must hear of it
            logger.exception("request %s failed", identifier)
            answer = {"error": {"code": _INTERNAL, "message": f"a mistake in Solidus' server: {error!r}"}}
        with self._lock:
            del self._jobs[identifier]
        if answer is not None and not job.stop.is_set():
            self.send({"id": identifier, **answer})


def result_of(tool: Any, given: Mapping[str, Any], job: Job) -> dict[str, Any]:
    """The result of a tool; what is wrong with its arguments, or with what they name, is a result too, from which an assistant
    can learn."""
    try:
        checks.check(tool.input, given)
        found = tool.work(given, job)
    except (SolidusError, OSError) as error:
        job.raise_if_stopped()
        found = tool.failure(error)
        return {"content": [{"type": "text", "text": found["error"]["message"]}], "structuredContent": found, "isError": True}
    job.raise_if_stopped()
    text = json.dumps(found, ensure_ascii=False, allow_nan=False)
    return {"content": [{"type": "text", "text": text}], "structuredContent": found, "isError": False}


Work = Callable[[Mapping[str, Any], Job], dict[str, Any]]
