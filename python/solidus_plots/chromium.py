"""A page as a PDF file, by a headless browser of Chromium's kind where one is installed."""

import os
from pathlib import Path
import shutil
import subprocess
import tempfile

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "microsoft-edge")
PATIENCE = 120  # [s] before a browser is given up


def find_browser():
    """The browser that SOLIDUS_BROWSER names (a name that is not there, or an empty one: none), else the first that is installed."""
    named = os.environ.get("SOLIDUS_BROWSER")
    if named is not None:
        return shutil.which(named) if named else None
    return next((found for found in map(shutil.which, BROWSERS) if found), None)


def print_page(browser, page, pdf):
    """Writes the PDF; returns an empty text, or why there is none.

    The browser writes to a folder of its own, so that a PDF that was there stays until the new one is whole. The page needs no net
    and has no scripts; only root, for whom Chromium has no sandbox, runs it without one.
    """
    with tempfile.TemporaryDirectory(prefix="solidus-pdf-", ignore_cleanup_errors=True) as folder:
        target = Path(folder) / "page.pdf"
        command = [browser, "--headless=new", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run", "--disable-extensions",
                   "--disable-background-networking", "--disable-component-update", f"--user-data-dir={folder}/profile",
                   "--no-pdf-header-footer", f"--print-to-pdf={target}", Path(page).resolve().as_uri()]
        if os.geteuid() == 0:
            command.insert(1, "--no-sandbox")
        try:
            ended = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace", timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            return f"{browser} did not end within {PATIENCE} s"
        except OSError as error:
            return f"{browser} cannot be started: {error.strerror}"
        if not target.is_file() or target.stat().st_size == 0:
            last = ended.stderr.strip().splitlines()[-1:] or ["it said nothing"]
            return f"{browser} wrote no PDF: {last[0][:200]}"
        shutil.copyfile(target, pdf)
    return ""
