"""Addresses beside the dashboard's own, for `panel serve --plugins deploy.patches.routes`."""

from .health import HealthHandler
from .metrics import MetricsHandler

ROUTES = [("/health", HealthHandler), ("/metrics", MetricsHandler)]
