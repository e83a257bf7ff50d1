"""Every setting: its name in the environment, its default, its range and its meaning.

The settings are read once at the start, before anything listens. `docs/deploy.md` lists the same
table, and a test compares the two. A value out of range ends the start with one line and exit
code 2.
"""

import errno
import os
import socket
import sys
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Any, NoReturn
from urllib.parse import urlsplit

from .kinds import (
    ADDRESS,
    FILE,
    FOLDER,
    ORIGINS,
    PATH,
    PORT,
    PREFIX,
    SECRET,
    UPSTREAM,
    Kind,
    choice,
    integer,
)

BAD_SETTING = 2  # exit code of a process whose settings cannot be used
LONGEST_SHOWN = 60  # characters of a value that an error message repeats
LOOPBACK = ("localhost", "127.0.0.1", "::1")  # names that no other site can own


def setting(name: str, default: str, kind: Kind, meaning: str) -> Any:
    """Declare a setting of the environment variable `name`."""
    return field(metadata={"name": name, "default": default, "kind": kind, "meaning": meaning})


@dataclass(frozen=True)
class Settings:
    """The settings of one server."""

    address: str = setting(
        "ADDRESS",
        "127.0.0.1",
        ADDRESS,
        "where to listen; 0.0.0.0 opens it to the network, :: to IPv4 and IPv6",
    )
    port: int = setting("PORT", "5006", PORT, "where to listen")
    origins: tuple[str, ...] = setting(
        "ROTORSTAB_ORIGINS",
        "",
        ORIGINS,
        "what the address line of the browsers shows; other host names get no connection. Without"
        " it: localhost, 127.0.0.1 and [::1] with PORT",
    )
    prefix: str = setting(
        "ROTORSTAB_PREFIX",
        "",
        PREFIX,
        "path below which everything is served, for a proxy of yours that has other services too;"
        " the proxy passes paths on unchanged",
    )
    outside_tls: str = setting(
        "ROTORSTAB_OUTSIDE_TLS",
        "no",
        choice("no", "yes"),
        "whether a proxy of yours ends TLS in front of this server; cookies are then for https://"
        " only",
    )
    workers: int = setting(
        "ROTORSTAB_WORKERS",
        "1",
        integer(1, 64),
        "number of identical workers, which share one secret",
    )
    worker_port: int = setting(
        "ROTORSTAB_WORKER_PORT",
        "5101",
        integer(1024, 65000),
        "port of the first worker on loopback, behind nginx; the other workers have the next ports",
    )
    secret: str = setting(
        "BOKEH_SECRET_KEY",
        "",
        SECRET,
        "signs sessions; the same for all workers, and known to nobody else",
    )
    secret_file: str = setting(
        "ROTORSTAB_SECRET_FILE",
        "~/.local/state/rotorstab/secret",
        PATH,
        "file with the secret where BOKEH_SECRET_KEY is not set; a single worker makes it",
    )
    max_sessions: int = setting(
        "ROTORSTAB_MAX_SESSIONS",
        "60",
        integer(1, 10000),
        "largest number of connected pages of one worker; the next page is answered 503 and waits",
    )
    token_lifetime: int = setting(
        "ROTORSTAB_TOKEN_LIFETIME",
        "3600",
        integer(60, 604800),
        "time in which a page must connect [s]",
    )
    unused_lifetime: int = setting(
        "ROTORSTAB_UNUSED_LIFETIME",
        "60",
        integer(5, 86400),
        "time for which a session is kept after its page has gone [s]",
    )
    keep_alive: int = setting(
        "ROTORSTAB_KEEP_ALIVE", "20", integer(1, 110), "time between two pings on a socket [s]"
    )
    lessons: str = setting("ROTORSTAB_LESSONS", "", FOLDER, "folder of the teacher's own lessons")
    log_level: str = setting(
        "ROTORSTAB_LOG_LEVEL",
        "info",
        choice("debug", "info", "warning", "error"),
        "least serious messages that are logged",
    )
    log_format: str = setting(
        "ROTORSTAB_LOG_FORMAT",
        "auto",
        choice("auto", "json", "text"),
        "one JSON object a line, or plain text; auto is plain text on a terminal, otherwise JSON",
    )
    drain: int = setting(
        "ROTORSTAB_DRAIN",
        "8",
        integer(1, 60),
        "time that running exports have left after SIGTERM [s]",
    )
    hang: int = setting(
        "ROTORSTAB_HANG",
        "60",
        integer(5, 3600),
        "time without a sign of life after which a worker ends itself, to be started again [s]",
    )
    metrics: str = setting(
        "ROTORSTAB_METRICS",
        "loopback",
        choice("off", "loopback", "on"),
        "who may read /metrics of a worker: nobody, this machine, everybody who reaches its port",
    )
    tls_certificate: str = setting(
        "ROTORSTAB_TLS_CERTIFICATE", "", FILE, "nginx: certificate chain (PEM); turns TLS on"
    )
    tls_key: str = setting("ROTORSTAB_TLS_KEY", "", FILE, "nginx: the certificate's key (PEM)")
    http_port: int = setting(
        "ROTORSTAB_HTTP_PORT",
        "0",
        integer(0, 65535),
        "nginx with TLS: a second port, mostly 80, which redirects http:// to https://; 0 for none",
    )
    hsts: int = setting(
        "ROTORSTAB_HSTS",
        "0",
        integer(0, 63_072_000),
        "nginx with TLS: time for which browsers that came once use this name with TLS only (HSTS)"
        " [s]; 0 sends nothing",
    )
    upstream: tuple[str, ...] = setting(
        "ROTORSTAB_UPSTREAM",
        "",
        UPSTREAM,
        "nginx alone, in a container: where the workers are; a name may stand for several",
    )


def host_name(origin: str) -> str:
    """Return the host of an origin, without its port and the brackets of an IPv6 address."""
    return urlsplit(f"//{origin}").hostname or ""


class SettingError(ValueError):
    """A setting that cannot be used; the message is one line."""


def read(environment: Mapping[str, str] = os.environ) -> Settings:
    """Return the settings of an environment, checked one by one and together.

    Raises
    ------
    SettingError
        Names the setting, what is allowed and the value (of a secret, only its length).
    """
    values: dict[str, Any] = {}
    for entry in fields(Settings):
        name, kind = entry.metadata["name"], entry.metadata["kind"]
        text = environment.get(name, "").strip() or entry.metadata["default"]
        try:
            values[entry.name] = kind.read(text)
        except ValueError:
            shown = str(len(text)) if kind is SECRET else repr(text[:LONGEST_SHOWN])
            raise SettingError(f"{name} must be {kind.allowed}, got {shown}") from None
    _check_together(values)
    port = values["port"]
    values["origins"] = values["origins"] or (
        f"localhost:{port}",
        f"127.0.0.1:{port}",
        f"[::1]:{port}",
    )
    return Settings(**values)


def _check_together(values: Mapping[str, Any]) -> None:
    """Raise SettingError where two settings contradict each other."""
    if bool(values["tls_certificate"]) != bool(values["tls_key"]):
        raise SettingError("ROTORSTAB_TLS_CERTIFICATE and ROTORSTAB_TLS_KEY are set together")
    for name, variable in (("hsts", "ROTORSTAB_HSTS"), ("http_port", "ROTORSTAB_HTTP_PORT")):
        if values[name] and not values["tls_certificate"]:
            raise SettingError(f"{variable} is for ROTORSTAB_TLS_CERTIFICATE, which is not set")
    if values["http_port"] == values["port"]:
        raise SettingError("ROTORSTAB_HTTP_PORT and PORT must be two ports")


def check_port(address: str, port: int, name: str = "PORT") -> None:
    """Raise SettingError where this process cannot listen on an address and a port.

    `name` is the setting that the message names.
    """
    where = f"{name} {port} of {address}"
    reasons = {
        errno.EADDRINUSE: f"{where} is in use",
        errno.EACCES: f"{where} is for root only: choose one from 1024 on",
        errno.EADDRNOTAVAIL: f"ADDRESS {address} is not one of this machine",
    }
    family = socket.AF_INET6 if ":" in address else socket.AF_INET
    try:
        with socket.socket(family) as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            probe.bind((address, port))
    except OSError as problem:
        reason = reasons.get(problem.errno or 0, f"{where}: {problem.strerror}")
        raise SettingError(reason) from None


def exit_with(problem: object) -> NoReturn:
    """Print one line on standard error and end the process with the code of a bad setting."""
    print(f"rotorstab: {problem}", file=sys.stderr)
    sys.exit(BAD_SETTING)
