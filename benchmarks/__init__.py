"""Speed of the solver and of the dashboard: `python -m benchmarks [name …]`."""
