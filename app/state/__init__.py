"""The state of the dashboard, its address, and rotor files: no Panel in it.

Read `inputs`, `state`, `address`, then `rotor_file`.
"""

from .state import PRESETS, SI_INPUTS, SYMBOLS, State

__all__ = ["PRESETS", "SI_INPUTS", "SYMBOLS", "State"]
