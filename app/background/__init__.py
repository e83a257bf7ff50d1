"""Work that would block the pages: processes and threads for it, and the files made there.

Read `threads`, `processes`, `settling`, then `printing`.
"""
