"""One worker: `python -m deploy.worker [directory or file of the app] [more of panel serve]`.

One process a worker: with Panel's --num-procs a stopped parent leaves its children serving.
"""

import os
import sys
from collections.abc import Sequence
from pathlib import Path

from . import dashboard
from .secret import find_secret
from .settings import SettingError, Settings, check_port, read, stop

LARGEST_MESSAGE = 262_144  # bytes
# options of panel serve that a server for others must not have, and why
REFUSED = {
    "num-procs": "its processes go on serving after the first one was stopped; ROTORSTAB_WORKERS "
    "and `python -m deploy.lab` start workers",
    "autoreload": "it watches the files of a developer",
    "dev": "it watches the files of a developer",
    "admin": "its pages have no login",
    "rest-provider": "its addresses have no login",
    "reuse-sessions": "users would share one page",
}


def command(settings: Settings, app: str, more: Sequence[str] = ()) -> list[str]:
    """Return the command line of `panel serve`, with more options of it."""
    options = {
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
    for word in more:
        given = word.partition("=")[0].removeprefix("--")
        # panel takes an option that is cut short
        for name, reason in REFUSED.items():
            if word.startswith("--") and given and name.startswith(given):
                raise SettingError(f"--{name} is not possible: {reason}")
    words = ["panel", "serve", app]
    for name, value in options.items():
        words += [f"--{name}", str(value)]
    # The token of a page stands readable in its HTML and holds what is listed here, nothing else:
    # cookies and passwords of other services on the same name stay out of it.
    words += ["--include-headers", "Host", "--include-cookies", "rotorstab"]
    for origin in settings.origins:
        words += ["--allow-websocket-origin", origin]
    return [*words, *more]


def main() -> None:
    """Check the settings, then serve until a signal."""
    try:
        settings = read()
        os.environ["BOKEH_SECRET_KEY"] = find_secret(settings, make=settings.workers == 1)
        check_port(settings)
    except SettingError as problem:
        stop(problem)
    os.environ |= {"BOKEH_SIGN_SESSIONS": "yes", "BOKEH_RESOURCES": "server"}
    # a worker is for one core; threads that wait for each other cost a settled map 40 % more
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    app = sys.argv[1] if len(sys.argv) > 1 else str(dashboard.FOLDER)
    if not Path(app).exists():
        stop(f"there is no app at {app}")
    try:
        arguments = command(settings, app, sys.argv[2:])
    except SettingError as problem:
        stop(problem)
    dashboard.served = dashboard.is_dashboard(app)
    from panel.command import main as panel  # seconds: not before the settings are known good

    sys.argv = arguments
    panel()


if __name__ == "__main__":
    main()
