"""What `bench_redraw` serves and runs in the browser."""
