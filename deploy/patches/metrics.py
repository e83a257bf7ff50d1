"""What Prometheus may read of a worker: sessions, sockets, updates, errors, caches, memory."""

from __future__ import annotations

import functools
import ipaddress
import logging
from collections.abc import Iterable
from typing import Any

from bokeh.server.contexts import ApplicationContext
from prometheus_client import (
    CONTENT_TYPE_LATEST,
    REGISTRY,
    Counter,
    Gauge,
    Histogram,
    Metric,
    generate_latest,
)
from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily
from prometheus_client.registry import Collector
from tornado.web import HTTPError, RequestHandler

from app.background import telemetry

from .. import dashboard
from ..settings import Settings
from . import sessions
from .patching import replace

BUCKETS = (0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 1, 2, 5)  # s

UPDATES = Histogram(
    "rotorstab_update_seconds", "From a page's message to its answer.", buckets=BUCKETS
)
ERRORS = Counter("rotorstab_errors", "Log records of level error or above.", ["logger"])
OPENINGS = Histogram("rotorstab_session_open_seconds", "To build a session.", buckets=BUCKETS)
SESSIONS = Gauge("rotorstab_sessions", "Sessions that are held or being built.")


class CountErrors(logging.Handler):
    """Counts log records by the first two words of their logger."""

    def emit(self, record: logging.LogRecord) -> None:
        ERRORS.labels(".".join(record.name.split(".")[:2])).inc()


class SharedCollector(Collector):
    """What the caches count that all sessions share."""

    def collect(self) -> Iterable[Metric]:
        hits = CounterMetricFamily("rotorstab_cache_hits", "Found in a cache.", labels=["cache"])
        misses = CounterMetricFamily("rotorstab_cache_misses", "Computed.", labels=["cache"])
        held = GaugeMetricFamily("rotorstab_cache_entries", "Held in a cache.", labels=["cache"])
        for name, info in dashboard.caches():
            hits.add_metric([name], info.hits)
            misses.add_metric([name], info.misses)
            held.add_metric([name], info.currsize)
        return hits, misses, held


class MetricsHandler(RequestHandler):
    """The text format of Prometheus; 404 for those who may not read it."""

    def initialize(self, readers: str) -> None:
        """Take who may read the metrics: the setting ROTORSTAB_METRICS."""
        self.readers = readers

    async def get(self) -> None:
        is_local = ipaddress.ip_address(self.request.remote_ip or "0.0.0.0").is_loopback
        # a request that comes through a proxy comes from the proxy's user
        is_forwarded = any(name.startswith("X-Forwarded") for name in self.request.headers)
        if self.readers != "on" and (self.readers == "off" or is_forwarded or not is_local):
            raise HTTPError(404)
        self.set_header("Cache-Control", "no-store")
        self.set_header("Content-Type", CONTENT_TYPE_LATEST)
        SESSIONS.set(sessions.documents(self.application))
        self.write(generate_latest())


def observe(name: str, value: float) -> None:
    """Take a measurement of the dashboard."""
    if name == "update":
        UPDATES.observe(value)


def install(settings: Settings) -> None:
    """Measure this process's server."""
    if settings.metrics == "off":
        return
    logging.getLogger().addHandler(CountErrors(logging.ERROR))
    REGISTRY.register(SharedCollector())
    Gauge("rotorstab_sockets", "Open sockets.").set_function(lambda: len(sessions.open_sockets))
    Gauge("rotorstab_places", "Sessions allowed at a time.").set(settings.max_sessions)
    create = ApplicationContext.create_session_if_needed

    @functools.wraps(create)
    async def timed(self: Any, session_id: str, *args: Any, **kwargs: Any) -> Any:
        if session_id in self._sessions or session_id in self._pending_sessions:
            return await create(self, session_id, *args, **kwargs)
        with OPENINGS.time():
            return await create(self, session_id, *args, **kwargs)

    replace(ApplicationContext, "create_session_if_needed", timed)
    telemetry.observers.append(observe)
