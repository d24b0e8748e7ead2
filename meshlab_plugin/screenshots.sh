#!/usr/bin/env bash
# Makes the pictures of the plugin in docs/: starts MeshLab 2020.09 with it on a screen of its own, and clicks through the
# menu as a user does.
#
#   meshlab_plugin/screenshots.sh PREFIX      PREFIX is what shadow_prefix.sh made
#
# Needs xvfb, openbox, xdotool and imagemagick.
set -euo pipefail

prefix=$(realpath "$1")
docs=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../docs")
work=$(mktemp -d)
export HOME=$work XDG_RUNTIME_DIR=$work QT_X11_NO_MITSHM=1
mkfifo "$work/number"
Xvfb -displayfd 3 -screen 0 1280x860x24 3>"$work/number" >/dev/null 2>&1 &
screen=$!
read -r number <"$work/number"
export DISPLAY=:$number
openbox >/dev/null 2>&1 &
manager=$!
sleep 1
"$prefix/bin/meshlab" >"$work/log" 2>&1 &
meshlab=$!
trap 'kill $meshlab $manager $screen 2>/dev/null; rm -rf "$work"' EXIT

wait_for() {
    for _ in $(seq 60); do
        xdotool search --onlyvisible --name "$1" >/dev/null 2>&1 && return
        sleep 1
    done
    echo "no window called $1" >&2
    return 1
}
take() {
    import -window root -colors 128 "PNG8:$docs/$1.png"
}
