"""Reads text of users, bounded and checked: numbers, quantities with units, TOML."""
