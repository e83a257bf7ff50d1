"""What a user describes: rotors, in non-dimensional or SI form, materials, and rotor files.

Read `shaft_disk`, the paper's rotor, and `materials`. Any other rotor is `parts`, then `rotor`;
`rotor_file` reads and writes it with `quantities`, and `ross` with `ross_elements` reads the files
of ROSS. `places` says where in a file an error is.
"""
