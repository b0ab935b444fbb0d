#!/usr/bin/env bash
# Checks an .rrd file and takes a screenshot of it without a display.
#
#   tools/screenshot_rerun.sh FILE.rrd OUT.png [WIDTHxHEIGHT]
#
# Needs tools/setup.sh (rerun-sdk of the program's version) and a software
# Vulkan driver: apt-get install mesa-vulkan-drivers libvulkan1
set -euo pipefail
recording=$1
picture=$2
size=${3:-1600x900}
tools=$(cd "$(dirname "$0")" && pwd)
python="$tools/../.venv/bin/python"
# The wrapper in bin/ does not pass signals on: run the program itself.
rerun=$("$python" -c 'import rerun_cli; print(rerun_cli.__path__[0])')/rerun
port=${RERUN_PORT:-29877}

"$rerun" rrd verify "$recording"

lavapipe=(/usr/share/vulkan/icd.d/lvp_icd*.json)
export VK_DRIVER_FILES=${lavapipe[0]} VK_ICD_FILENAMES=${lavapipe[0]}
unset DISPLAY WAYLAND_DISPLAY
log=$(mktemp)
"$rerun" --headless --bind 127.0.0.1 --port "$port" --window-size "$size" \
    --hide-welcome-screen "$recording" >"$log" 2>&1 &
viewer=$!
trap 'kill "$viewer" 2>/dev/null || true; rm -f "$log"' EXIT

if ! timeout 180 "$python" "$tools/screenshot_rerun.py" "$port" "$picture"; then
    cat "$log" >&2
    exit 1
fi
