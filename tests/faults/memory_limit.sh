#!/usr/bin/env bash
# memory_limit.sh ETALON: meshes of 10^7 triangles in a process limited to 1 GiB are refused before they are parsed, the need stated, and
# nothing is written; 10^4 triangles are read there. The large files have holes (their numbers read as zeros), for no one reads them that far.
# Ends with one line of counts; exit code 2 where a run was neither.
set -u
[ $# -eq 1 ] || { sed -n '2,/^set -u/{/^set -u/d;s/^# \{0,1\}//;p}' "$0" >&2; exit 64; }
etalon=$(realpath -- "$1") || exit 4
folder=$(mktemp -d) || exit 4
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 4

"$etalon" make knot --faces 10000 -o small.ply --quiet || exit 4
faces=10000000 vertices=5000000
{ head -c 80 /dev/zero; printf '\200\226\230\000'; } >large.stl # 10^7, little-endian
truncate -s $((84 + 50 * faces)) large.stl
printf 'ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\nelement face %d\nproperty list uchar uint vertex_indices\nend_header\n' \
  $vertices $faces >large.ply
truncate -s $(($(stat -c %s large.ply) + 12 * vertices + 13 * faces)) large.ply
{ yes 'v 0 0 0' | head -n $vertices; yes 'f 1 2 3' | head -n $faces; } >large.obj

failed=0 refused=0 done=0
# limited ARGUMENTS…: 1 GiB of address space, 10 s of processor time (a refusal takes one, most of it to read the file).
limited() { (ulimit -v 1048576 && ulimit -t 10 && exec "$etalon" "$@" --quiet --threads 2 2>error); }
for model in large.stl large.ply large.obj; do
  for verb in "info $model" "simplify $model --faces 1000 -o out.obj" "progressive $model -o out.epm" "metro $model small.ply" \
    "render $model -o out.png" "bake $model --faces 1000 -o out.glb"; do
    # shellcheck disable=SC2086 # words of a command
    limited $verb
    code=$?
    pattern="^etalon: error: .*large\.... *: $faces triangles, $vertices vertices: expected at least [0-9.]+ [MG]B of memory for it, got [0-9.]+ [MG]B, left of 1\.07 GB: the limit of address space \(ulimit -v\)\$"
    if [ "$code" -eq 4 ] && [ "$(wc -l <error)" -eq 1 ] && grep -Eq "$pattern" error && [ -z "$(ls out* 2>/dev/null)" ]; then
      refused=$((refused + 1))
    else
      failed=$((failed + 1))
      printf '[etalon] failed: memory_limit: %s: exit code %d: %s\n' "$verb" "$code" "$(head -c 300 error)"
    fi
  done
done
for verb in "info small.ply" "simplify small.ply --faces 1000 -o out.obj" "progressive small.ply -o out.epm" "metro small.ply small.ply" "render small.ply --size 64 -o out.png"; do
  # shellcheck disable=SC2086
  if limited $verb >/dev/null; then done=$((done + 1)); else failed=$((failed + 1)); printf '[etalon] failed: memory_limit: %s: %s\n' "$verb" "$(head -c 300 error)"; fi
done
printf 'memory_limit: %d refused, the need stated; %d of small files done; %d wrong\n' "$refused" "$done" "$failed"
[ "$failed" -eq 0 ] || exit 2
