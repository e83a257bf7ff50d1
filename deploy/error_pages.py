"""Error pages: one look, light and dark; they fetch nothing and say nothing about the server."""

from __future__ import annotations

import html
from http import HTTPStatus

from .constants import BUSY_SECONDS, LONGEST_ADDRESS, RESTART_SECONDS, RETRY_SECONDS

STYLE = """
:root { color-scheme: light dark; --ink: #1c2430; --quiet: #5b6675; --paper: #f6f7f9;
  --card: #fff; --line: #d9dee5; --link: #1857a4 }
@media (prefers-color-scheme: dark) { :root { --ink: #e6eaf0; --quiet: #a3aebd;
  --paper: #12161c; --card: #1b212a; --line: #333c48; --link: #8ab8f5 } }
body { margin: 0; min-height: 100vh; display: grid; place-items: center; background: var(--paper);
  color: var(--ink); font: 1rem/1.55 system-ui, sans-serif }
main { box-sizing: border-box; width: min(32rem, 100vw - 2rem); padding: 2rem;
  background: var(--card); border: 1px solid var(--line); border-radius: .75rem }
p { margin: 0 0 .75rem } p:last-child { margin: 0 } .name, .code { color: var(--quiet) }
h1 { margin: 0 0 .75rem; font-size: 1.35rem; line-height: 1.3 }
a { color: var(--link) }
"""

TEXTS: dict[int, tuple[str, tuple[str, ...]]] = {
    400: ("This request cannot be read", ("The address may have to begin with https://.",)),
    403: ("This is not allowed here", ("The server did not accept this request.",)),
    404: ("There is no such page", ("The address may be mistyped.",)),
    405: ("This is not allowed here", ("Pages of this server can only be read.",)),
    413: ("This is too large", ("This address accepts no uploads.",)),
    414: (
        "This address is too long",
        (
            f"It has more than {LONGEST_ADDRESS} characters, so its parameters cannot be read.",
            "The dashboard opens with its default parameters.",
        ),
    ),
    421: (
        "This server does not go by that name",
        (
            "Use the address that you were given.",
            "Whoever runs the server can add the name to ROTORSTAB_ORIGINS.",
        ),
    ),
    429: (
        "Too many pages are opened at once",
        (f"This page tries again by itself every {BUSY_SECONDS} seconds; you need do nothing.",),
    ),
    431: (
        "This request is too large",
        ("Its headers cannot be read. Remove the cookies of this site, then open it again.",),
    ),
    500: ("Something went wrong", ("The server has noted it. Reload the page to try again.",)),
    503: (
        "All places are taken",
        (
            f"This page tries again by itself every {RETRY_SECONDS} seconds; you need do nothing.",
            "A place is free again when somebody closes their tab.",
        ),
    ),
}
RESTARTS = (
    "The server restarts",
    (f"This page tries again by itself every {RESTART_SECONDS} seconds; you need do nothing.",),
)
LINKED = (400, 403, 404, 405, 413, 414, 431, 500)  # pages with a link to the dashboard
WAITS = {429: BUSY_SECONDS, 503: RETRY_SECONDS}  # s until the page tries again, and Retry-After


def retry_seconds(status: int, restarting: bool = False) -> int | None:
    """Return the seconds after which a request may be sent again, or None."""
    return RESTART_SECONDS if restarting and status == 503 else WAITS.get(status)


def error_page(status: int, restarting: bool = False, prefix: str = "") -> str:
    """Return the HTML of the page of a status.

    Parameters
    ----------
    status : int
        Of the reply.
    restarting : bool
        Whether 503 means that the server restarts; otherwise it means that all places are taken.
    prefix : str
        Path below which the dashboard is served.
    """
    try:
        phrase = HTTPStatus(status).phrase
    except ValueError:
        phrase = "Error"
    restarting = restarting and status == 503
    title, sentences = RESTARTS if restarting else TEXTS.get(status, (phrase, ()))
    wait = retry_seconds(status, restarting)
    again = f'<meta http-equiv="refresh" content="{wait}">' if wait else ""
    link = f'<p><a href="{prefix}/app">Open the dashboard</a></p>' if status in LINKED else ""
    text = "".join(f"<p>{html.escape(sentence)}</p>" for sentence in sentences)
    return (
        f'<!doctype html><html lang="en"><head><meta charset="utf-8">{again}'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{html.escape(title)} — rotorstab</title><style>{STYLE}</style></head>"
        f'<body><main><p class="name">rotorstab</p><h1>{html.escape(title)}</h1>{text}{link}'
        f'<p class="code">{status} {html.escape(phrase)}</p></main></body></html>'
    )
