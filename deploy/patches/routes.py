"""Further addresses of a worker, for `panel serve --plugins deploy.patches.routes`."""

from ..settings import read
from .health import HealthHandler
from .metrics import MetricsHandler

ROUTES = [
    ("/health", HealthHandler),
    ("/metrics", MetricsHandler, {"readers": read().metrics}),
]
