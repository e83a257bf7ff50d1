"""Stability over the whole plane of pulsating load and excitation frequency, and its margins."""
