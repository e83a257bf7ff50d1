"""What a user describes: the rotor in non-dimensional and SI form, and materials of shafts.

Read `shaft_disk`, the paper's rotor, then `materials`.
"""
