"""How a rotor whirls under a steady load, and which steady load it bears."""
