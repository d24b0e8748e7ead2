#!/usr/bin/env bash
# Makes the pictures of the plugin in docs/: starts MeshLab 2020.09 with it on a screen of its own, and clicks through
# the menu as a user does.
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

# The window with this in its name, once it is there.
window() {
    for _ in $(seq 60); do
        xdotool search --onlyvisible --name "$1" 2>/dev/null | head -1 | grep . && return
        sleep 1
    done
    echo "no window called $1" >&2
    return 1
}
# Opens the dialog of a filter by MeshLab's search field.
open_filter() {
    xdotool windowactivate "$main"
    sleep 1
    xdotool key ctrl+f
    sleep 1
    xdotool type --delay 60 "$1"
    sleep 1
    xdotool key Down
    sleep 1
    xdotool key Return
    dialog=$(window "$1")
    sleep 2
}
# Presses the dialog's lower right button, Apply, and closes the dialog.
apply_filter() {
    eval "$(xdotool getwindowgeometry --shell "$dialog")"
    xdotool mousemove --window "$dialog" $((WIDTH * 3 / 4)) $((HEIGHT - 20)) click 1
    sleep "$1"
    xdotool mousemove --window "$dialog" $((WIDTH / 4)) $((HEIGHT - 20)) click 1
    sleep 2
}
# Saves the screen, or one window, as a small picture.
take() {
    import -window "${2:-root}" +dither -colors 64 "PNG8:$docs/$1.png"
}

main=$(window "MeshLab 2020")
sleep 3
open_filter "Polycube: Example"
apply_filter 5
xdotool mousemove 121 29 click 1
sleep 1
xdotool key --delay 200 Down Down Down Down Down Down Right
sleep 1
take meshlab-menu
xdotool key --delay 200 Escape Escape Escape
open_filter "Polycube: Quad Remesh"
take meshlab-dialog "$dialog"
apply_filter 20
xdotool mousemove 430 460 mousedown 1
for _ in $(seq 20); do xdotool mousemove_relative 4 4; done
xdotool mouseup 1
sleep 2
take meshlab-result
