"""What does a user take away? Files of charts, the report, the view as a program.

Read `seen` (charts as the user sees them) and `rows` (parameters and numbers in tables); then
`files`, `picture` and `report`; `program_case`, `program`, `snippet` and `snippet_charts` write the
program. `shell` makes pictures and tables outside the browser.
"""
