#!/bin/sh
# Serve the dashboard with one worker: deploy/start.sh [directory or file of the app] [more options of panel serve]
# The settings are environment variables: docs/deploy.md. PYTHON names the interpreter of the environment.
set -eu
exec "${PYTHON:-python3}" -m deploy.worker "$@"
