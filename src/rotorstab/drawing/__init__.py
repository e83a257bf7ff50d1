"""Pictures and tables: on the screen and in print through HoloViews, and as CSV and JSON.

Read `screen` with `sources`, `contours` and `hooks`, which draws a `Chart` with Bokeh, and
`notebook`, the same with title and legend. Then `printed` draws a `Figure` with Matplotlib, with
the `printed_…` modules, `typesetting` and `text_blocks`; `tables` writes its data, with
`plain_text` and `files`; `formats` lists the file formats of both. No other folder of the library
imports HoloViews; `tables` and `formats` work without it, and `extra` is the error where it is
missing.
"""
