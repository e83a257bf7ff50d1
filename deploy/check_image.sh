#!/bin/sh
# Build the Dockerfile without a Docker engine, then run the image as compose.yaml does: a plain
# user, no capabilities, a read-only root, 192 MB in /tmp. Ends with "image check passed".
#
#   deploy/check_image.sh [BASE]    as root, with buildah; BASE is an image with Python >= 3.11
#
# Without BASE a Debian base is made with mmdebstrap, of SUITE (stable, or oldstable) and, where the
# machine has a mirror of its own, from MIRROR (a line of sources.list). Not checked here: the real
# base image, HEALTHCHECK, compose's network and limits.
set -eu

project=$(cd -- "$(dirname -- "$0")/.." && pwd)
base=${1:-}
work=$(mktemp -d)
# root in a container often has no overlay file system
build() { buildah --storage-driver vfs "$@"; }
container=
server=
finish() {
    [ -z "$server" ] || kill "$server" 2>/dev/null || :
    [ -z "$server" ] || wait "$server" 2>/dev/null || :
    [ -z "$container" ] || build rm "$container" >/dev/null || :
    rm -rf "$work"
}
trap finish EXIT
trap 'exit 1' INT TERM

if [ -z "$base" ]; then
    suite=${SUITE:-stable}
    base=localhost/rotorstab-base-$suite
    if ! build inspect --type image "$base" >/dev/null 2>&1; then
        mmdebstrap --quiet --variant=minbase --include=python3,python3-venv,ca-certificates \
            "$suite" "$work/base.tar" ${MIRROR:+"$MIRROR"}
        empty=$(build from scratch)
        build add --quiet "$empty" "$work/base.tar" / >/dev/null
        build commit --quiet "$empty" "$base" >/dev/null
        build rm "$empty" >/dev/null
        rm "$work/base.tar"
    fi
fi

# the host's certificates and pip settings, because a lab may have a mirror of its own
set -- --volume /etc/ssl/certs:/etc/ssl/certs:ro
[ ! -f /etc/pip.conf ] || set -- "$@" --volume /etc/pip.conf:/etc/pip.conf:ro
build bud --isolation chroot --format docker --build-arg "BASE=$base" "$@" \
    --tag localhost/rotorstab "$project"

container=$(build from localhost/rotorstab)
root=$(build mount "$container")
port=$(python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])')
address=$(build inspect --format '{{range .OCIv1.Config.Env}}{{println .}}{{end}}' "$container")
entry=$(build inspect --format '{{range .OCIv1.Config.Entrypoint}}{{println .}}{{end}}' "$container")

# a mount namespace of its own, which ends with the process
printf '%s\n' "$address" "ADDRESS=127.0.0.1" "PORT=$port" "ROTORSTAB_ORIGINS=localhost:$port" \
    >"$work/environment"
unshare --mount sh -eu -c '
    mount --bind "$1" "$1"
    mount -o remount,bind,ro "$1"
    mount -t tmpfs -o size=192m,mode=1777 tmpfs "$1/tmp"
    mount -t tmpfs -o size=1m,mode=0700,uid=10001,gid=10001 tmpfs "$1/var/lib/rotorstab"
    mount -t proc proc "$1/proc"
    mount --bind /dev "$1/dev"
    shift_root=$1 environment=$2
    shift 2
    # capabilities are dropped before the user changes: afterwards setpriv of Debian stable refuses
    exec env -i $(cat "$environment") chroot "$shift_root" setpriv --bounding-set=-all --inh-caps=-all \
        --reuid=10001 --regid=10001 --clear-groups --no-new-privs "$@"
' sh "$root" "$work/environment" $entry >"$work/log" 2>&1 &
server=$!

tries=0
answered=yes
until python3 - "$port" <<'PYTHON'
import sys, urllib.request
for path in ("/health", "/app"):
    with urllib.request.urlopen(f"http://127.0.0.1:{sys.argv[1]}{path}", timeout=30) as reply:
        assert reply.status == 200, path
PYTHON
do
    tries=$((tries + 1))
    if [ $tries -ge 30 ] || ! kill -0 "$server"; then
        answered=no
        break
    fi
    sleep 2
done 2>"$work/probe"
if [ "$answered" = no ]; then
    cat "$work/probe" "$work/log" >&2
    echo "image check failed: the container does not answer" >&2
    exit 1
fi

python3 - "$server" <<'PYTHON'
import sys
process = f"/proc/{sys.argv[1]}"
status = dict(line.split(":", 1) for line in open(f"{process}/status").read().splitlines())
mounts = [line.split() for line in open(f"{process}/mountinfo")]
root = next(mount for mount in mounts if mount[4] == "/")
assert status["Uid"].split() == ["10001"] * 4, status["Uid"]
assert int(status["CapEff"], 16) == int(status["CapPrm"], 16) == 0, status["CapEff"]
assert status["NoNewPrivs"].strip() == "1"
assert "ro" in root[5].split(","), root
PYTHON

kill -TERM "$server"
wait "$server" && status=0 || status=$?
server=
[ "$status" -eq 0 ] || { cat "$work/log" >&2; echo "image check failed: SIGTERM ended with $status" >&2; exit 1; }
echo "image check passed: built, answered as a plain user on a read-only root, ended on SIGTERM"
