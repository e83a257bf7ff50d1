#!/bin/sh
# Serve the dashboard: deploy/start.sh [directory or file of the app] [more options of panel serve].
# ADDRESS, PORT         where to listen (127.0.0.1, 5006)
# ROTORSTAB_ORIGINS     host:port that browsers use, comma-separated (localhost:PORT,127.0.0.1:PORT)
# ROTORSTAB_MAX_SESSIONS  places (60)
# BOKEH_SECRET_KEY      at least 32 characters, the same on all workers (made anew at each start)
# PYTHON                interpreter with the packages (python3)
set -eu

here=$(dirname -- "$0")
app=${1:-$(dirname -- "$here")/app}
[ $# -eq 0 ] || shift
python=${PYTHON:-python3}
address=${ADDRESS:-127.0.0.1}
port=${PORT:-5006}

if [ -z "${BOKEH_SECRET_KEY:-}" ]; then
    BOKEH_SECRET_KEY=$("$python" -c 'import secrets; print(secrets.token_hex(32))')
elif [ ${#BOKEH_SECRET_KEY} -lt 32 ]; then
    echo "BOKEH_SECRET_KEY must have at least 32 characters, got ${#BOKEH_SECRET_KEY}" >&2
    exit 2
fi
export BOKEH_SECRET_KEY BOKEH_SIGN_SESSIONS=yes BOKEH_RESOURCES=server

for origin in $(echo "${ROTORSTAB_ORIGINS:-localhost:$port,127.0.0.1:$port}" | tr ',' ' '); do
    set -- --allow-websocket-origin "$origin" "$@"
done

shown=$address
[ "$address" = 0.0.0.0 ] && shown=localhost
echo "rotorstab: http://$shown:$port/ (Ctrl-C stops it)"

# One process a worker: with --num-procs a stopped parent leaves its children serving.
exec "$python" -m panel serve "$app" \
    --address "$address" --port "$port" --setup "$here/setup.py" --liveness \
    --websocket-max-message-size 262144 --session-token-expiration 3600 \
    --keep-alive 20000 --unused-session-lifetime 60000 --check-unused-sessions 15000 \
    "$@"
