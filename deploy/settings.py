"""Every setting: its name in the environment, its default, its range, its meaning.

Read once at start, before anything listens; `docs/deploy.md` lists the same table and a test
compares them. A value that nobody can have meant stops the start with one line and exit code 2.
"""

import errno
import os
import re
import socket
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields
from ipaddress import ip_address
from pathlib import Path
from typing import Any, NamedTuple, NoReturn
from urllib.parse import urlsplit

LONGEST_SHOWN = 60
LOOPBACK = ("localhost", "127.0.0.1", "::1")  # no other site can take these names
HOST = r"([A-Za-z0-9]([A-Za-z0-9.-]{0,251}[A-Za-z0-9])?|\[[0-9A-Fa-f:.]{2,45}\])"


class Kind(NamedTuple):
    """How a setting's text is read (ValueError where it cannot be), and what is allowed."""

    read: Callable[[str], Any]
    allowed: str


def whole(lowest: int, highest: int) -> Kind:
    """Return the kind of a whole number in a range."""

    def read(text: str) -> int:
        if not re.fullmatch("[0-9]{1,9}", text) or not lowest <= int(text) <= highest:
            raise ValueError
        return int(text)

    return Kind(read, f"an integer from {lowest} to {highest}")


def one_of(*words: str) -> Kind:
    """Return the kind of one of some words."""
    return Kind(lambda text: words[words.index(text)], f"one of {', '.join(words)}")


def listed(pattern: str, allowed: str) -> Kind:
    """Return the kind of several texts of a pattern, between commas or spaces."""

    def read(text: str) -> tuple[str, ...]:
        found = tuple(one for one in re.split(r"[,\s]+", text) if one)
        if not all(re.fullmatch(pattern, one) for one in found):
            raise ValueError
        return found

    return Kind(read, allowed)


def readable(test: Callable[[Path], bool], allowed: str) -> Kind:
    """Return the kind of a path that is there and can be read; empty means none."""

    def read(text: str) -> str:
        if text and not (test(Path(text)) and os.access(text, os.R_OK)):
            raise ValueError
        return text

    return Kind(read, allowed)


def _key(text: str) -> str:
    if text and len(text) < 32:
        raise ValueError
    return text


def _prefix(text: str) -> str:
    if not re.fullmatch("((/[A-Za-z0-9_~-][A-Za-z0-9_.~-]*)*)/?", text):
        raise ValueError
    return text.rstrip("/")


ADDRESS = Kind(lambda text: str(ip_address(text)), "an IP address")
FILE = readable(Path.is_file, "a file that can be read")
FOLDER = readable(Path.is_dir, "a folder that can be read")
KEY = Kind(_key, "at least 32 characters")
PATH = Kind(str, "a path")
ORIGINS = listed(HOST + "(:[0-9]{1,5})?", "host or host:port as browsers write it, comma-separated")
UPSTREAM = listed("[A-Za-z0-9_.-]+:[0-9]{1,5}", "host:port, comma-separated")


PREFIX = Kind(_prefix, "empty or a path such as /rotorstab")


def setting(name: str, default: str, kind: Kind, meaning: str) -> Any:
    """Declare a setting."""
    return field(metadata={"name": name, "default": default, "kind": kind, "meaning": meaning})


@dataclass(frozen=True)
class Settings:
    """What a server is told by its environment."""

    address: str = setting(
        "ADDRESS",
        "127.0.0.1",
        ADDRESS,
        "where to listen; 0.0.0.0 opens it to the network, :: to IPv4 and IPv6",
    )
    port: int = setting("PORT", "5006", whole(1, 65535), "where to listen")
    origins: tuple[str, ...] = setting(
        "ROTORSTAB_ORIGINS",
        "",
        ORIGINS,
        "what browsers have in their address line; others get no connection. Without it:"
        " localhost, 127.0.0.1 and [::1] with PORT",
    )
    prefix: str = setting(
        "ROTORSTAB_PREFIX",
        "",
        PREFIX,
        "path below which everything is served, where a proxy of yours shares its name with other"
        " services; the proxy passes paths on as they are",
    )
    outside_tls: str = setting(
        "ROTORSTAB_OUTSIDE_TLS",
        "no",
        one_of("no", "yes"),
        "whether a proxy of yours ends TLS in front of this server: cookies are for https:// only",
    )
    workers: int = setting(
        "ROTORSTAB_WORKERS", "1", whole(1, 64), "identical workers; they share one secret"
    )
    worker_port: int = setting(
        "ROTORSTAB_WORKER_PORT",
        "5101",
        whole(1024, 65000),
        "first worker's port on loopback, behind nginx; the others follow",
    )
    secret: str = setting(
        "BOKEH_SECRET_KEY", "", KEY, "signs sessions; the same for all workers, and told to nobody"
    )
    secret_file: str = setting(
        "ROTORSTAB_SECRET_FILE",
        "~/.local/state/rotorstab/secret",
        PATH,
        "holds the secret where BOKEH_SECRET_KEY is not set; a single worker makes it",
    )
    max_sessions: int = setting(
        "ROTORSTAB_MAX_SESSIONS",
        "60",
        whole(1, 10000),
        "connected pages of one worker at a time; the next is told to wait (503)",
    )
    token_lifetime: int = setting(
        "ROTORSTAB_TOKEN_LIFETIME", "3600", whole(60, 604800), "s a page may take to connect"
    )
    unused_lifetime: int = setting(
        "ROTORSTAB_UNUSED_LIFETIME",
        "60",
        whole(5, 86400),
        "s that a session is kept after its page has gone",
    )
    keep_alive: int = setting(
        "ROTORSTAB_KEEP_ALIVE", "20", whole(1, 110), "s between pings on a socket"
    )
    lessons: str = setting("ROTORSTAB_LESSONS", "", FOLDER, "the teacher's own lessons")
    log_level: str = setting(
        "ROTORSTAB_LOG_LEVEL", "info", one_of("debug", "info", "warning", "error"), "what is logged"
    )
    log_format: str = setting(
        "ROTORSTAB_LOG_FORMAT",
        "auto",
        one_of("auto", "json", "text"),
        "a JSON object a line or plain text; auto is text on a terminal",
    )
    drain: int = setting(
        "ROTORSTAB_DRAIN", "8", whole(1, 60), "s that running exports have left after SIGTERM"
    )
    hang: int = setting(
        "ROTORSTAB_HANG",
        "60",
        whole(5, 3600),
        "s without a sign of life after which a worker ends itself, to be started again",
    )
    metrics: str = setting(
        "ROTORSTAB_METRICS",
        "loopback",
        one_of("off", "loopback", "on"),
        "who may read a worker's /metrics: nobody, this machine, all that reach its port",
    )
    tls_certificate: str = setting(
        "ROTORSTAB_TLS_CERTIFICATE", "", FILE, "nginx: certificate chain (PEM); turns TLS on"
    )
    tls_key: str = setting("ROTORSTAB_TLS_KEY", "", FILE, "nginx: the certificate's key (PEM)")
    http_port: int = setting(
        "ROTORSTAB_HTTP_PORT",
        "0",
        whole(0, 65535),
        "nginx with TLS: a second port, mostly 80, whose http:// addresses are sent on to https://;"
        " 0 for none",
    )
    hsts: int = setting(
        "ROTORSTAB_HSTS",
        "0",
        whole(0, 63_072_000),
        "nginx with TLS: s for which browsers that came once use nothing but TLS for this name"
        " (HSTS); 0 sends nothing",
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
    """A setting that cannot be used, in one line."""


def read(environment: Mapping[str, str] = os.environ) -> Settings:
    """Return the settings, checked one by one and together.

    Raises
    ------
    SettingError
        Naming the setting, what is allowed and the value (of a secret, its length).
    """
    found = {}
    for one in fields(Settings):
        name, kind = one.metadata["name"], one.metadata["kind"]
        text = environment.get(name, "").strip() or one.metadata["default"]
        try:
            found[one.name] = kind.read(text)
        except ValueError:
            shown = str(len(text)) if kind is KEY else repr(text[:LONGEST_SHOWN])
            raise SettingError(f"{name} must be {kind.allowed}, got {shown}") from None
    if bool(found["tls_certificate"]) != bool(found["tls_key"]):
        raise SettingError("ROTORSTAB_TLS_CERTIFICATE and ROTORSTAB_TLS_KEY are set together")
    for name, variable in (("hsts", "ROTORSTAB_HSTS"), ("http_port", "ROTORSTAB_HTTP_PORT")):
        if found[name] and not found["tls_certificate"]:
            raise SettingError(f"{variable} is for ROTORSTAB_TLS_CERTIFICATE, which is not set")
    if found["http_port"] == found["port"]:
        raise SettingError("ROTORSTAB_HTTP_PORT and PORT must be two ports")
    port = found["port"]
    found["origins"] = found["origins"] or (
        f"localhost:{port}",
        f"127.0.0.1:{port}",
        f"[::1]:{port}",
    )
    return Settings(**found)


def check_port(settings: Settings, name: str = "PORT") -> None:
    """Raise SettingError where the address or the port of a setting cannot be had; 0 is none."""
    address, port = (
        settings.address,
        {
            "PORT": settings.port,
            "ROTORSTAB_HTTP_PORT": settings.http_port,
        }[name],
    )
    if not port:
        return
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
        told = reasons.get(problem.errno or 0, f"{where}: {problem.strerror}")
        raise SettingError(told) from None


def stop(problem: object) -> NoReturn:
    """End the process with one line and exit code 2."""
    print(f"rotorstab: {problem}", file=sys.stderr)
    sys.exit(2)
