"""One worker: `python -m deploy.worker [directory or file of the app] [options of panel serve]`.

One process is one worker. Panel's `--num-procs` is refused, because its processes go on serving
after their parent was stopped.
"""

import os
import sys
from collections.abc import Sequence
from pathlib import Path

from . import dashboard
from .secret import find_secret
from .settings import SettingError, Settings, check_port, exit_with, read

LARGEST_MESSAGE = 262_144  # bytes
REFUSED = {
    "num-procs": "its processes go on serving after the first one was stopped; ROTORSTAB_WORKERS "
    "and `python -m deploy.lab` start workers",
    "autoreload": "it watches the files of a developer",
    "dev": "it watches the files of a developer",
    "admin": "its pages have no login",
    "rest-provider": "its addresses have no login",
    "reuse-sessions": "users would share one page",
}
"""Options of `panel serve` that a server for others must not have, and why."""


def refuse(options: Sequence[str]) -> None:
    """Raise SettingError where one of the options is refused."""
    for option in options:
        written = option.partition("=")[0].removeprefix("--")
        # argparse, which reads Panel's options, takes an abbreviated name for the whole one
        for name, reason in REFUSED.items():
            if option.startswith("--") and written and name.startswith(written):
                raise SettingError(f"--{name} is not possible: {reason}")


def command(settings: Settings, app: str, more: Sequence[str] = ()) -> list[str]:
    """Return the command line of `panel serve` for an app.

    Parameters
    ----------
    settings : Settings
        Of this server.
    app : str
        Directory or file of the app.
    more : sequence of str
        Further options of `panel serve`.

    Returns
    -------
    list of str
        The words of the command line, beginning with `panel`.

    Raises
    ------
    SettingError
        Where an option of `more` is one of `REFUSED`.
    """
    refuse(more)
    options: dict[str, object] = {
        # without an address Tornado listens for IPv4 and IPv6
        **({} if settings.address == "::" else {"address": settings.address}),
        "port": settings.port,
        **({"prefix": settings.prefix} if settings.prefix else {}),
        "setup": Path(__file__).with_name("setup.py"),
        "plugins": "deploy.patches.routes",
        "websocket-max-message-size": LARGEST_MESSAGE,
        "session-token-expiration": settings.token_lifetime,
        "keep-alive": settings.keep_alive * 1000,
        "unused-session-lifetime": settings.unused_lifetime * 1000,
        "check-unused-sessions": min(5, settings.unused_lifetime) * 1000,
    }
    words = ["panel", "serve", app]
    for name, value in options.items():
        words += [f"--{name}", str(value)]
    # The token of a page can be read in its HTML, and it contains the headers and cookies that are
    # listed here. Cookies and passwords of other services on the same host name stay out of it.
    words += ["--include-headers", "Host", "--include-cookies", "rotorstab"]
    for origin in settings.origins:
        words += ["--allow-websocket-origin", origin]
    return [*words, *more]


def main() -> None:
    """Check the settings, then serve until a signal comes."""
    app = sys.argv[1] if len(sys.argv) > 1 else str(dashboard.FOLDER)
    try:
        settings = read()
        os.environ["BOKEH_SECRET_KEY"] = find_secret(settings, make=settings.workers == 1)
        check_port(settings.address, settings.port)
        if not Path(app).exists():
            raise SettingError(f"there is no app at {app}")
        words = command(settings, app, sys.argv[2:])
    except SettingError as problem:
        exit_with(problem)
    os.environ |= {"BOKEH_SIGN_SESSIONS": "yes", "BOKEH_RESOURCES": "server"}
    # A worker is for one core: threads of OpenBLAS that wait for each other make a full map 40 %
    # more expensive.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    dashboard.served = dashboard.is_dashboard(app)
    from panel.command import main as panel_command  # takes seconds: after the settings are checked

    sys.argv = words
    panel_command()


if __name__ == "__main__":
    main()
