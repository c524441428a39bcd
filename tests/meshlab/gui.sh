#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# MeshLab's windows on a virtual screen: previews and applies a filter, exports the surface, sets parameters of another filter and
# applies it. What happened is read from MeshLab's log; the pictures of the screen stay in FOLDER, to be looked at.
# Usage: gui.sh MESHLAB MESH FOLDER      needs Xvfb, openbox, xdotool, ImageMagick; FOLDER gets part.pov, part.scad, *.png
set -u
meshlab=$(realpath "$1") mesh=$(realpath "$2")
mkdir -p "$3" && cd "$3" || exit 1
folder=$PWD
rm -f part.* ./*.png
home=$(mktemp -d)
export HOME=$home XDG_RUNTIME_DIR=$home XDG_CONFIG_HOME=$home/.config LIBGL_ALWAYS_SOFTWARE=1
chmod 700 "$home"
pids=()
stop() { # only what this script started
  kill "${pids[@]}" 2>/dev/null
  wait 2>/dev/null
  rm -rf "$home"
}
trap stop EXIT
fail() {
  echo "FAILED: $1"
  import -window root "$folder/failed.png" 2>/dev/null
  tail -n 8 "$folder/log"
  exit 1
}
wait_for() { # SECONDS COMMAND...
  local i n=$(($1 * 10))
  shift
  for ((i = 0; i < n; i++)); do "$@" && return 0; sleep 0.1; done
  return 1
}
log_has() { grep -aq -- "$1" "$folder/log"; }

# ---- a screen, a window manager, which gives the focus, and MeshLab ----

Xvfb -displayfd 1 -screen 0 1280x900x24 +extension GLX -nolisten tcp >"$home/display" 2>/dev/null & pids+=($!)
is_up() { [ -s "$home/display" ] && DISPLAY=:$(cat "$home/display") xdpyinfo >/dev/null 2>&1; }
wait_for 20 is_up || fail "no screen"
DISPLAY=:$(cat "$home/display")
export DISPLAY
openbox >/dev/null 2>&1 & pids+=($!)
"$meshlab" "$mesh" >"$folder/log" 2>&1 & pids+=($!)
wait_for 60 log_has "All files opened" || fail "the mesh was not opened"
# "xdotool search --sync" ends with an error when a window vanishes, as MeshLab's first one does
find_window() { window=$(xdotool search --onlyvisible --name '^MeshLab 20' 2>/dev/null | tail -n 1); [ -n "$window" ]; }
wait_for 20 find_window || fail "no window"
sleep 0.5

# ---- dialogs: new windows of MeshLab, without a title of their own ----

windows() { xdotool search --onlyvisible --class meshlab 2>/dev/null | sort; }
# The largest window that is not in $before: its place goes to X, Y, WIDTH, HEIGHT, its number to dialog.
find_dialog() {
  local each best=0
  dialog=
  for each in $(comm -13 <(echo "$before") <(windows)); do
    eval "$(xdotool getwindowgeometry --shell "$each" 2>/dev/null)" || continue
    if [ "$WIDTH" -gt 200 ] && [ "$HEIGHT" -gt 100 ] && [ $((WIDTH * HEIGHT)) -gt $best ]; then
      best=$((WIDTH * HEIGHT)) dialog=$each
    fi
  done
  [ -n "$dialog" ] && eval "$(xdotool getwindowgeometry --shell "$dialog")"
}
click() { xdotool mousemove $((X + $1)) $((Y + HEIGHT - $2)) click 1; sleep 0.2; } # from the left and from the bottom
open_filter() { # NAME: by the box for searching
  xdotool windowactivate --sync "$window" key ctrl+f
  sleep 0.7
  xdotool type --delay 15 "$1"
  sleep 0.7
  before=$(windows)
  xdotool key Down
  sleep 0.2
  xdotool key Return
  wait_for 10 find_dialog || fail "no dialog of $1"
  sleep 0.5
  find_dialog
}
apply() { click $((WIDTH * 3 / 4)) 22; }
close() { click $((WIDTH / 4)) 22; sleep 0.3; }

# ---- curvature: Preview, then Apply ----

open_filter "Fairsurf: Curvature and continuity"
click 26 84
n_applied() { [ "$(grep -ac "Applied filter Fairsurf: Curvature" log)" -eq "$1" ]; } # previews are logged too
wait_for 30 n_applied 1 || fail "no preview"
sleep 1
import -window root curvature-preview.png
apply
wait_for 30 n_applied 2 || fail "the filter was not applied"
close
sleep 1
import -window root curvature.png

# ---- File > Export Mesh As ----

export_as() { # FILE
  before=$(windows)
  xdotool windowactivate --sync "$window" key ctrl+shift+e
  wait_for 10 find_dialog || fail "no dialog for $1"
  sleep 0.5
  xdotool key ctrl+a
  xdotool type --delay 15 "$folder/$1"
  before=$(windows)
  xdotool key Return
  wait_for 10 find_dialog || fail "no options for $1"
  sleep 0.5
  [ "$1" != part.pov ] || import -window root export-options.png
  xdotool key Return
  is_written() { [ -s "$folder/$1" ]; }
  wait_for 30 is_written "$1" || fail "$1 was not written"
  sleep 0.5
}
export_as part.pov
export_as part.scad

# ---- fairing, in place and coarser than initially ----

open_filter "Fairsurf: Fair surface"
click 26 92 # not into a new layer
xdotool mousemove $((X + 395)) $((Y + HEIGHT - 153)) click --repeat 3 --delay 50 1
xdotool type --delay 15 0.5
xdotool key Tab
click 466 122 # colour: the first measure
xdotool key Down
sleep 0.2
xdotool key Return
sleep 0.2
import -window root fair-parameters.png
apply
wait_for 200 log_has "Applied filter Fairsurf: Fair" || fail "the surface was not faired"
sleep 1
close
import -window root fair.png
echo "log: $(grep -a 'curvature variation S' log | tail -n 1)"
grep -aq "cut into [1-4] x" log || fail "the tolerance was not taken: $(grep -a 'cut into' log)"
echo PASS
