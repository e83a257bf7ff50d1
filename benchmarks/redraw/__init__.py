"""Pages and scripts of `bench_redraw`."""
