"""Text that somebody else wrote, bounded and checked: numbers, quantities with units, TOML."""
