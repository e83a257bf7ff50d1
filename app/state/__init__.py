"""The state of the dashboard, its address, and rotor files: no Panel in it.

Read `declaration` and one of the files of inputs, then `inputs`, `state`, `address`, `rotor_file`.
"""

from .declaration import Use
from .inputs import SI_INPUTS, SYMBOLS, names_for
from .point_inputs import INITIAL_CONDITIONS
from .state import PRESETS, State

__all__ = ["INITIAL_CONDITIONS", "PRESETS", "SI_INPUTS", "SYMBOLS", "State", "Use", "names_for"]
