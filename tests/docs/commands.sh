#!/usr/bin/env bash
# commands.sh ETALON SOURCE [PAGE …]: runs what README.md and docs/ print, as printed. The lines of each block marked as shell are run in
# order, a page in one empty folder, with this build as `etalon` and `build/cli/etalon`; a reader's own files (scan.ply, photo.png, …) are
# stood in for by procedural ones. Of `etalon …` in running text every option must be one of the verb's. Lines that install, build or measure
# for long only have to name programs that the tree has. Studies of full size run with ETALON_FULL=1.
# Ends with one line of counts; exit code 2 where a command fails.
set -u
[ $# -ge 2 ] || { sed -n '2,/^set -u/{/^set -u/d;s/^# \{0,1\}//;p}' "$0" >&2; exit 64; }
etalon=$(realpath -- "$1") || exit 4
source=$(realpath -- "$2") || exit 4
shift 2
folder=$(mktemp -d) || exit 4
trap 'rm -rf "$folder"' EXIT
cd "$source" || exit 4
pages=("$@")
[ $# -gt 0 ] || mapfile -t pages < <(ls README.md docs/*.md docs/papers/*.md)
mkdir "$folder/bin"
ln -s "$etalon" "$folder/bin/etalon"
export PATH="$folder/bin:$PATH"
ran=0 named=0 skipped=0 options=0 failed=0

fail() { failed=$((failed + 1)); printf '[etalon] failed: docs: %s\n' "$1"; }

# What a reader has, by name.
stand_in() {
  case $1 in
    scan.ply) etalon make duck --faces 4000 -o scan.ply ;;
    head.obj) etalon make head -o head.obj ;;
    depth.tif | colour.png) etalon make range --image ramp -o depth.tif && mv depth_color.png colour.png ;;
    dem.tif | photo.png) etalon make terrain --size 65 -o dem.tif && mv dem_color.png photo.png ;;
    candidate.png) etalon render golden.draws -o candidate.png ;;
    *) return 1 ;;
  esac >/dev/null
}

# Of the tree, not of a reader's folder: these must be there.
names_the_tree() {
  case $1 in
    ./run* | ./check* | tests/*) [ -x "$source/${1%% *}" ] ;;
    cmake\ --preset*) grep -q "\"name\": *\"$(sed 's/cmake --preset \([^ ]*\).*/\1/' <<<"$1")\"" "$source/CMakePresets.json" ;;
    build/tests/*) [ -d "$source/tests/$(cut -d/ -f3 <<<"$1")" ] ;;
    perf\ *) true ;;
    *) return 1 ;;
  esac
}

run_line() {
  local place=$1 line=$2 word code limit=120
  case $line in
    ./run* | ./check* | tests/* | cmake\ --preset* | build/tests/* | perf\ *)
      if names_the_tree "$line"; then named=$((named + 1)); else fail "$place: not in the tree: $line"; fi
      return ;;
  esac
  case $line in
    *' study '*)
      if [ "${line/ --quick/}" = "$line" ]; then
        if [ -z "${ETALON_FULL:-}" ]; then skipped=$((skipped + 1)); return; fi
        limit=7200
      fi ;;
  esac
  for word in ${line%%#*}; do
    case $word in *.*) [ -e "$word" ] || [[ " $line " == *" -o $word "* ]] || [[ " $line " == *" --html $word "* ]] || stand_in "$word" || true ;; esac
  done
  timeout "$limit" bash -c "$line" >output 2>&1
  code=$?
  ran=$((ran + 1))
  [ "$code" -eq 0 ] || fail "$place: exit code $code: $line: $(tail -n 1 output | head -c 200)"
}

for page in "${pages[@]}"; do
  work=$folder/$(tr / _ <<<"$page")
  mkdir -p "$work/build/cli"
  ln -s "$etalon" "$work/build/cli/etalon"
  cd "$work" || exit 4
  while IFS=$'\t' read -r number line; do run_line "$page:$number" "$line"; done < <(
    awk '/^```/ { shell = !inside && ($0 ~ /^```(sh|bash|shell|console)$/); inside = !inside; next } shell && /[^ ]/ && !/^#/ { print NR "\t" $0 }' "$source/$page")
  # `etalon VERB … --option …` of the running text.
  while read -r verb option; do
    options=$((options + 1))
    [ -e "$folder/$verb.help" ] || etalon "$verb" --help >"$folder/$verb.help" 2>&1
    grep -Eq -- "(^|[ ,])$option([ ,]|\$)" "$folder/$verb.help" || fail "$page: 'etalon $verb' has no $option"
  done < <(grep -o '`etalon [a-z][^`]*`' "$source/$page" | tr -d '`' | awk '{ for (i = 3; i <= NF; ++i) if ($i ~ /^--[a-z]/) { sub(/[^-a-z].*/, "", $i); print $2, $i } }' | sort -u)
done
printf 'docs: %d commands run as printed, %d of the tree named right, %d options of running text known, %d long ones need ETALON_FULL=1, %d failed\n' \
  "$ran" "$named" "$options" "$skipped" "$failed"
[ "$failed" -eq 0 ] || exit 2
