"""A client of the Model Context Protocol over pipes, with nothing but the standard library: it holds every message of the server to the
protocol."""

import json
import os
import queue
import subprocess
import threading

from program import PATIENCE, PROGRAM


class Client:
    """Starts ``solidus mcp FOLDER`` and talks to it."""

    def __init__(self, folder, *options, cwd=None, temporary=None):
        environment = {**os.environ, **({} if temporary is None else {"TMPDIR": str(temporary)})}
        self.process = subprocess.Popen([PROGRAM, "mcp", str(folder), *options], cwd=cwd, env=environment, text=True,
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.notifications, self._answers, self._heard = [], queue.Queue(), []
        self._number = 0
        self._readers = [threading.Thread(target=read, daemon=True) for read in (self._read, self._listen)]
        for reader in self._readers:
            reader.start()

    def _read(self):
        for line in self.process.stdout:
            message = json.loads(line)  # nothing else is written there
            assert message["jsonrpc"] == "2.0", message
            if "method" in message:
                assert "id" not in message, message
                self.notifications.append(message)
            else:
                assert ("result" in message) != ("error" in message), message
                self._answers.put(message)
        self._answers.put(None)

    def _listen(self):
        for line in self.process.stderr:
            self._heard.append(line)

    @property
    def heard(self):
        """What it has written to standard error."""
        return "".join(self._heard)

    def send(self, text):
        self.process.stdin.write(text + "\n")
        self.process.stdin.flush()

    def notify(self, method, **params):
        self.send(json.dumps({"jsonrpc": "2.0", "method": method, "params": params}))

    def request(self, method, params=None):
        """Sends a request and returns its id."""
        self._number += 1
        self.send(json.dumps({"jsonrpc": "2.0", "id": self._number, "method": method, **({} if params is None else {"params": params})}))
        return self._number

    def answer(self):
        """The next answer; None at the end of the server."""
        return self._answers.get(timeout=240 * PATIENCE)

    def ask(self, method, params=None):
        number = self.request(method, params)
        answer = self.answer()
        assert answer is not None and answer["id"] == number, (method, answer, self.heard)
        return answer

    def initialize(self, version="2025-11-25"):
        answer = self.ask("initialize", {"protocolVersion": version, "capabilities": {}, "clientInfo": {"name": "test", "version": "1"}})
        self.notify("notifications/initialized")
        return answer["result"]

    def call(self, tool, token=None, **arguments):
        """The result of a tool."""
        meta = {} if token is None else {"_meta": {"progressToken": token}}
        return self.ask("tools/call", {"name": tool, "arguments": arguments, **meta})["result"]

    def close(self):
        """Ends the session as the protocol says and returns the exit code."""
        self.process.stdin.close()
        code = self.process.wait(timeout=120 * PATIENCE)
        for reader in self._readers:
            reader.join()
        for stream in (self.process.stdout, self.process.stderr):
            stream.close()
        return code


def misfits(schema, value, path="result"):
    """What of a value does not fit to its JSON Schema, as far as the schemas of the server go."""
    kinds = schema.get("type", [])
    kinds = [kinds] if isinstance(kinds, str) else kinds
    types = {"object": dict, "array": list, "string": str, "boolean": bool, "null": type(None), "integer": int, "number": (int, float)}
    if kinds and not any(isinstance(value, types[kind]) and (kind == "boolean" or not isinstance(value, bool)) for kind in kinds):
        return [f"{path}: {value!r} is none of {kinds}"]
    found = [f"{path}: {value!r} is none of {schema['enum']}"] if value not in schema.get("enum", [value]) else []
    if isinstance(value, dict):
        known = schema.get("properties", {})
        found += [f"{path}: {name} is missing" for name in schema.get("required", []) if name not in value]
        if schema.get("additionalProperties") is False:
            found += [f"{path}: {name} is not declared" for name in value if name not in known]
        for name, inner in known.items():
            found += misfits(inner, value[name], f"{path}.{name}") if name in value else []
    if isinstance(value, list):
        found += [text for entry in value for text in misfits(schema.get("items", {}), entry, path)]
    if "anyOf" in schema and all(misfits(choice, value, path) for choice in schema["anyOf"]):
        found.append(f"{path}: fits to none of the choices")
    return found
