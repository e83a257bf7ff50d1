"""How the dashboard is served to a class.

`settings` (with `kinds` and `secret`) reads the environment, `worker` starts one server, `setup`
hardens it with `patches`, `lab` starts several (`processes`) behind nginx (`nginx`, `nginx_log`),
and `command` is `rotorstab serve`.
"""
