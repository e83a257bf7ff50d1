"""What changes on the page without being rebuilt? Charts that are patched, and the sidebar.

Read `controls`, then `drawing` and `chart`; `overlay` adds marks to a chart, `low` and `small` are
charts for little room.
"""
