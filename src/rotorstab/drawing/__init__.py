"""Pictures and tables: on the screen and in print through HoloViews, and as CSV and JSON.

The only folder that imports HoloViews, and only in `screen` and `printed`.
"""
