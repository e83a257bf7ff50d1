"""Programs that measure the solver and the dashboard: `python -m benchmarks [name …]`."""
