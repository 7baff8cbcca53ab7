#!/usr/bin/env bash
# kill_writes.sh ETALON COUNT: a program that is killed (SIGKILL) at a random time while it replaces files leaves of each the old one or the new one,
# never a part. Old and new differ, so a mixture would be seen. Temporary files may stay behind: nobody is left to remove them; they are counted.
# Ends with one line of counts; exit code 2 where a file is neither.
set -u
[ $# -eq 2 ] || { sed -n '2,/^set -u/{/^set -u/d;s/^# \{0,1\}//;p}' "$0" >&2; exit 64; }
etalon=$(realpath -- "$1") || exit 4
count=$2
folder=$(mktemp -d) || exit 4
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 4
mkdir old new work

# make N FOLDER: outputs of several files and formats; N is the version.
commands=(
  'make knot --faces $((20000 + 2000 * n)) -o $to/knot.ply'
  'make head --faces $((600 + 200 * n)) --texture-size $((256 + 256 * n)) -o $to/head.obj --json $to/head.json'
  'make swirl --faces $((800 + 200 * n)) --texture-size $((256 + 256 * n)) -o $to/swirl.glb'
  'progressive old/swirl.glb --collapse $([ $n = 0 ] && echo half || echo full) --no-cells -o $to/swirl.epm'
  'render old/head.obj --size $((300 + 100 * n)) --margins --write-draws $to/head.draws -o $to/head.exr'
)
run() { local n=$1 to=$2 command; eval "command=\"${commands[$3]}\""; set -- $command; "$etalon" "$@" --quiet --threads 1 >/dev/null 2>&1; }
longest_ms=()
for c in "${!commands[@]}"; do
  run 0 old "$c" || { echo "kill_writes: command $c does not run" >&2; exit 4; }
  start=$(date +%s%N)
  run 1 new "$c"
  longest_ms+=($((($(date +%s%N) - start) / 1000000 + 20)))
done

state=${ETALON_SEED:-1} killed=0 finished=0 as_old=0 as_new=0 temporary=0 broken=0
for ((i = 0; i < count; ++i)); do
  c=$((i % ${#commands[@]}))
  rm -rf work && cp -r old work || exit 4
  state=$(((state * 1103515245 + 12345) % 2147483648))
  delay_ms=$((longest_ms[c] / 3 + state / 1024 % longest_ms[c] * 2 / 3)) # starting takes the first third
  eval "n=1 to=work; words=\"${commands[c]}\""
  # shellcheck disable=SC2086 # words of a command
  "$etalon" $words --quiet --threads 1 >/dev/null 2>&1 &
  pid=$!
  sleep "$((delay_ms / 1000)).$(printf '%03d' $((delay_ms % 1000)))"
  if kill -KILL "$pid" 2>/dev/null; then killed=$((killed + 1)); else finished=$((finished + 1)); fi
  wait "$pid" 2>/dev/null
  for file in work/*; do
    name=${file#work/}
    if cmp -s "$file" "old/$name"; then as_old=$((as_old + 1))
    elif cmp -s "$file" "new/$name"; then as_new=$((as_new + 1))
    elif [ ! -e "old/$name" ] && [ ! -e "new/$name" ]; then temporary=$((temporary + 1))
    elif [ "${name##*.}" = json ] && tail -c 2 "$file" | grep -q '}'; then as_new=$((as_new + 1)) # its `run` tells times
    else broken=$((broken + 1)); printf '[etalon] failed: kill_writes: run %d left a part of %s\n' "$i" "$name"; fi
  done
done
printf 'kill_writes: %d killed, %d had ended; files: %d old, %d new, %d temporary left, %d neither\n' "$killed" "$finished" "$as_old" "$as_new" "$temporary" "$broken"
[ "$broken" -eq 0 ] || exit 2
