"""Further addresses of a worker, for `panel serve --plugins deploy.patches.routes`."""

from .health import HealthHandler
from .metrics import MetricsHandler

ROUTES = [("/health", HealthHandler), ("/metrics", MetricsHandler)]
