"""The parts of `bench_classroom`: simulated users, the deployment, faults and tables."""
