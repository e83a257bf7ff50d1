"""A class at once: what `bench_classroom` opens, moves, kills and counts."""
