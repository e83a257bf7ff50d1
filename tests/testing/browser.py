"""Find a Chromium for the browser tests, or install one.

`python -m tests.testing.browser` prints its path.

Order: the environment's CHROMIUM, the system's browsers, Playwright's own download; then an
installation with apt-get (as root) or with Playwright.
"""

import os
import shutil
import subprocess
import sys

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
FLAGS = (
    "--no-sandbox",  # a root user in a container has none
    "--disable-gpu",
    # no request of its own
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
)
HELP = (
    "no Chromium found and none could be installed: install your distribution's chromium package,"
    " or set CHROMIUM=/path/to/chrome, or run `make unit` for the tests that need no browser"
)


def runs(path: str) -> bool:
    """Whether the file starts as a browser; a packaged stub or a missing library does not."""
    try:
        done = subprocess.run([path, "--version"], capture_output=True, timeout=60, check=False)
    except (OSError, subprocess.TimeoutExpired):
        return False
    return done.returncode == 0 and b"Chrom" in done.stdout


def find_browser() -> str | None:
    """Path of a browser that starts, or None. CHROMIUM counts alone where it is set."""
    if chosen := os.environ.get("CHROMIUM"):
        path = shutil.which(chosen)
        return path if path and runs(path) else None
    for name in NAMES:
        if (path := shutil.which(name)) and runs(path):
            return path
    try:
        from playwright.sync_api import sync_playwright

        with sync_playwright() as playwright:
            path = playwright.chromium.executable_path
    except Exception:
        return None
    return path if os.path.exists(path) and runs(path) else None


def install_browser() -> None:
    """Install Chromium in the ways that this user may; output goes to standard error."""
    environment = os.environ | {"DEBIAN_FRONTEND": "noninteractive"}
    attempts = [[[sys.executable, "-m", "playwright", "install", "chromium"]]]
    if hasattr(os, "geteuid") and os.geteuid() == 0 and shutil.which("apt-get"):
        attempts.insert(
            0,
            [
                ["apt-get", "update"],
                ["apt-get", "install", "--yes", "--no-install-recommends", "chromium"],
            ],
        )
    for commands in attempts:
        for command in commands:
            print("+", *command, file=sys.stderr)
            done = subprocess.run(
                command, env=environment, stdin=subprocess.DEVNULL, stdout=sys.stderr, check=False
            )
            if done.returncode != 0:
                break
        if find_browser():
            return


def main() -> int:
    """Print the browser's path; exit 1 with one message where there is none."""
    path = find_browser()
    if path is None and os.environ.get("CHROMIUM"):
        print(f"CHROMIUM={os.environ['CHROMIUM']} does not start as a browser", file=sys.stderr)
        return 1
    if path is None:
        install_browser()
        path = find_browser()
    if path is None:
        print(HELP, file=sys.stderr)
        return 1
    print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main())
