#!/bin/sh
# judge_pictures.sh GOLDEN PICTURES DEVICE: every picture of one folder against the golden one of its name in the other.
# Exit code 0: all agree, or a waiver covers it. 1: nothing could be proven (a golden without its draws). 2: a texel is unexplained. 3, 4: sizes, files.
set -eu
golden=$1 pictures=$2 device=$3
set -- "$golden" "$pictures" --device "$device" --html pictures.html --junit pictures.xml --json pictures.json
if [ -f "$golden/waivers.json" ]; then set -- "$@" --waivers "$golden/waivers.json"; fi
exec "${ETALON:-etalon}" diff "$@"
