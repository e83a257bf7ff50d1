"""What a hostile client sends."""
