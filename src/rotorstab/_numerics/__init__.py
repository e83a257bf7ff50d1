"""Mathematics that knows no rotor: roots of many quartics at once."""
