"""Work that would block the pages: its processes, its threads, and the files made there."""
