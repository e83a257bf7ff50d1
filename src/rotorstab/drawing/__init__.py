"""Pictures and tables: on the screen and in print through HoloViews, and as CSV and JSON.

`screen` draws a `Chart` with Bokeh, `notebook` the same with title and legend, `printed` draws a
`Figure` with Matplotlib, `tables` writes it. Only this folder imports HoloViews, and not `tables`.
"""
