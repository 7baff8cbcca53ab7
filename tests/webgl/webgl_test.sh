#!/usr/bin/env bash
# webgl_test.sh ETALON EXAMPLES: the head by WebGL2 in a browser, right and wrong drawings, judged by etalon diff (judge_pictures.sh); with ETALON_FULL
# and ETALON_DATA the real head too. Skipped where there is no Chromium.
set -u
here=$(cd -P -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
etalon=$1 examples=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

judge() {  # NAME ARGUMENT…
  local name=$1 status=0
  shift
  mkdir "$work/$name"
  "$here/judge_pictures.sh" "$etalon" "$examples" "$work/$name" "$@" || status=$?
  case $status in
    0) ;;
    1) echo "[etalon] skipped: webgl $name: no Chromium with WebGL2 here"; [ "$name" = head ] && exit 77 ;;
    *) echo "[etalon] failed: webgl $name"; exit 2 ;;
  esac
}

judge head
real="${ETALON_DATA:-/nonexistent}/lee_perry_smith"
if [ -z "${ETALON_FULL:-}" ]; then exit 0; fi
if [ -f "$real/LeePerrySmith.glb" ]; then judge real_head "$real/LeePerrySmith.glb" --texture "$real/Map-COL.jpg" --flip-v
else echo "[etalon] skipped: webgl real_head: no real inputs (ETALON_DATA)"; fi
