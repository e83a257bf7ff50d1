"""Pictures and tables: on the screen and in print through HoloViews, and as CSV and JSON.

`screen` draws a `Chart` with Bokeh, `notebook` the same with title and legend, `printed` draws a
`Figure` with Matplotlib, `tables` writes its data, and `formats` lists the file formats of both. No
other folder of the library imports HoloViews; `tables` and `formats` work without it.
"""
