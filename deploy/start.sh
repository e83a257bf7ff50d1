#!/bin/sh
# Serve the dashboard with one worker: deploy/start.sh [directory or file of the app] [more options of panel serve]
# Settings come from the environment: docs/deploy.md. PYTHON: interpreter with the packages.
set -eu
exec "${PYTHON:-python3}" -m deploy.worker "$@"
