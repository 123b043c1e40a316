#!/bin/bash
# window.sh BLENDER FOLDER: runs window.py in a Blender with a window, on a display of its own, drawn in software. It
# leaves its pictures in the folder. What goes wrong in a panel Blender only prints: that fails too.
# -noreset: else Xvfb signals xvfb-run once more when the last window goes, and that may take the signal for an error.
set -u
rm -rf "$2" && mkdir -p "$2"
export LIBGL_ALWAYS_SOFTWARE=1
xvfb-run -a -s "-noreset -screen 0 1400x900x24 -fbdir $2" "$1" --factory-startup --enable-event-simulate --window-geometry 0 0 1400 900 \
    --python "$(dirname "$0")/window.py" -- "$2" 2>&1 | tee "$2/output.txt"
status=${PIPESTATUS[0]}
if grep -q "Traceback\|Error: Python" "$2/output.txt"; then
    exit 1
fi
exit "$status"
