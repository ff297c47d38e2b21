"""Runs of one case at the same time, each with changes of its own and in a folder of its own (study, uncertain)."""

from concurrent.futures import ThreadPoolExecutor
import json
import os
import signal
import subprocess
import threading
import time

from solidus_plots.vtu import ResultError

RECORD = "run.json"  # in the folder of a run: its changes and how it ended
INTERRUPTED = 130


def program():
    """The program that runs the cases: the one that was called."""
    return os.environ.get("SOLIDUS_PROGRAM", "solidus")


def jobs_from(text):
    """Runs at a time: what the option says, without it one a core. Throws ResultError."""
    if text and not (text.isdigit() and int(text) > 0):
        raise ResultError(f"--jobs is a whole number of runs at a time, not '{text}'")
    if text:
        return int(text)
    # The program that called knows which processors share a core, and what its container may use.
    return int(os.environ.get("SOLIDUS_CORES") or len(os.sched_getaffinity(0)))


def how_it_ended(record):
    return "interrupted" if record is None else "finished" if record["code"] == 0 else record["reason"]


def _reason(log, code):
    """Why a run failed: the last thing it said on its own."""
    lines = [line for line in log.read_text(errors="replace").splitlines() if line.strip()]
    begins = [i for i, line in enumerate(lines) if line.startswith("solidus: ")]
    if begins:
        return lines[begins[-1]].removeprefix("solidus: ").strip()
    return f"exit code {code}" + (f": {lines[-1].strip()}" if lines else "")


class Runner:
    """Runs what is to be run and keeps a record of each."""

    def __init__(self, case, restart, limit=None):
        """case: as behind `run`; restart: keep runs that have ended; limit: of wall time of one [s]."""
        self._case, self._restart, self._limit = case, restart, limit
        self._processes, self._lock, self._stopped = set(), threading.Lock(), False

    def run(self, folder, words):
        """The record of a run: {case, arguments, code, reason, seconds}; nothing where it was interrupted."""
        record_file = folder / RECORD
        if self._restart and record_file.exists():
            record = json.loads(record_file.read_text())
            if record.get("arguments") == words and record.get("case", str(self._case)) == str(self._case):
                return record
        folder.mkdir(parents=True, exist_ok=True)
        record_file.unlink(missing_ok=True)
        start, log = time.monotonic(), folder / "log.txt"
        with log.open("w") as out:
            with self._lock:
                if self._stopped:
                    return None
                process = subprocess.Popen([program(), "run", str(self._case), "-o", str(folder), "--no-progress",
                                            "--processes", "1", *words], stdout=out, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                                           start_new_session=True,  # Ctrl-C is handed on by stop(), once
                                           env={**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"})
                self._processes.add(process)
            reason = None
            try:
                code = process.wait(self._limit)
            except subprocess.TimeoutExpired:
                process.kill()
                code, reason = process.wait(), f"stopped after the limit of {self._limit:g} s"
            with self._lock:
                self._processes.discard(process)
        if self._stopped:
            return None
        record = {"case": str(self._case), "arguments": words, "code": code, "seconds": round(time.monotonic() - start, 3),
                  "reason": reason or ("" if code == 0 else _reason(log, code))}
        record_file.write_text(json.dumps(record, indent=2) + "\n")
        return record

    def run_all(self, wanted, jobs, announce):
        """The records of many runs, in their order; nothing after Ctrl-C.

        wanted: [(folder, words)]; announce(number, record) is called for each, in order.
        """
        records = []
        try:
            with ThreadPoolExecutor(jobs) as pool:
                try:
                    for number, record in enumerate(pool.map(lambda one: self.run(*one), wanted)):
                        records.append(record)
                        announce(number, record)
                except KeyboardInterrupt:
                    self.stop()
                    raise
        except KeyboardInterrupt:
            return None
        return records

    def stop(self):
        """No further run begins; those that are under way leave a checkpoint."""
        with self._lock:
            self._stopped = True
            for process in self._processes:
                process.send_signal(signal.SIGINT)
