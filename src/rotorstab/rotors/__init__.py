"""What a user describes: rotors, in non-dimensional or SI form, materials, and rotor files.

Read `shaft_disk`, the paper's rotor, and `materials`. Any other rotor is `sections` and `parts`,
whose fields `fields` checks, then `rotor`. `rotor_file` reads and writes it with `quantities`;
`ross` reads the files of ROSS with `ross_tables`, `ross_shaft` and `ross_bearings`. `places` says
where in a file an error is, and `presets` are rotors to start from.
"""
