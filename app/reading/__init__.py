"""How is text of users read? Bounded and checked: numbers, quantities with units, TOML.

Read `user_error`, then `numbers`, `quantities`, `toml` and `tables`.
"""
