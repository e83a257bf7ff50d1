"""How the dashboard is served to a class.

`settings` (with `kinds` and `secret`) reads the environment, and `constants` holds the values that
workers and nginx share. `worker` starts one server, `setup` hardens it with `patches`, and
`dashboard` is what they ask of the dashboard. `lab` starts several workers (`processes`) behind
nginx (`nginx`, `nginx_log`). `error_pages` makes the error pages of both, `check` is the health
check of a container, and `command` is `rotorstab serve`.
"""
