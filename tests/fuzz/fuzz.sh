#!/usr/bin/env bash
# fuzz.sh BUILD SECONDS [JOBS] [NAME …]: runs the libFuzzer targets of the build folder BUILD (preset fuzz) for SECONDS each, JOBS at a time (default: one
# a processor), from the seeds of the tree and what earlier runs found new (BUILD/fuzz/NAME/corpus).
# A finding leaves its input as BUILD/fuzz/findings/NAME-…; run it again: cd BUILD/fuzz/NAME && ../../tests/fuzz/etalon_fuzz_NAME FILE
# With ETALON_FUZZ_LOG=FILE targets that pass are noted there, and those that are there already are not run again.
# Ends with "fuzz: N passed, N failed, N skipped"; exit code 2 after a finding.
set -u
[ $# -ge 2 ] || { sed -n '2,/^set -u/{/^set -u/d;s/^# \{0,1\}//;p}' "$0" >&2; exit 64; }
source=$(cd -P -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd) || exit 4
build=$(cd -P -- "$1" && pwd) || exit 4
seconds=$2 jobs=${3:-$(nproc)}
shift $(($# < 3 ? $# : 3))
if [ $# -gt 0 ]; then names=("$@"); else
  names=()
  for program in "$build"/tests/fuzz/etalon_fuzz_*; do
    case $program in *.*|*'*') ;; *) names+=("${program##*/etalon_fuzz_}") ;; esac
  done
fi
mkdir -p "$build/fuzz/findings" || exit 4

# Leaks of libraries that are made once, by name.
export LSAN_OPTIONS="suppressions=$source/../support/lsan.supp:print_suppressions=0"
export UBSAN_OPTIONS=print_stacktrace=1

# seeds_of NAME: folders with seeds; frozen streams are seeds of their readers.
seeds_of() {
  [ -d "$source/corpus/$1" ] && printf '%s\n' "$source/corpus/$1"
  local extension='' file
  case $1 in epm) extension=epm ;; joint) extension=ejt ;; terrain) extension=ettm ;; texture) extension=etws ;; draws) extension=draws ;; esac
  [ -n "$extension" ] || return 0
  mkdir -p "$build/fuzz/$1/streams"
  for file in "$source"/../../data/streams/v*/*."$extension"; do
    [ -f "$file" ] && cp "$file" "$build/fuzz/$1/streams/"
  done
  printf '%s\n' "$build/fuzz/$1/streams"
}

# run_one NAME: a whole line at its end, so that lines of two runs do not mix.
run_one() {
  local name=$1 work="$build/fuzz/$1" program="$build/tests/fuzz/etalon_fuzz_$1" status=0 runs coverage seeds
  if [ ! -x "$program" ]; then printf '[etalon] skipped: fuzz %s: not built\n' "$name"; return 0; fi
  if [ -n "${ETALON_FUZZ_LOG:-}" ] && grep -qxF "$name $seconds" "$ETALON_FUZZ_LOG" 2>/dev/null; then
    printf 'fuzz %s: passed, before\n' "$name"
    return 0
  fi
  mkdir -p "$work/corpus"
  mapfile -t seeds < <(seeds_of "$name")
  (cd "$work" && "$program" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=4096 -malloc_limit_mb=2048 -print_final_stats=1 \
    -artifact_prefix="$build/fuzz/findings/$name-" corpus "${seeds[@]}") >"$work/log" 2>&1 </dev/null || status=$?
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$work/log")
  coverage=$(grep -ao 'cov: [0-9]* ft: [0-9]*' "$work/log" | tail -n 1)
  if [ "$status" -eq 0 ]; then
    printf 'fuzz %s: passed, %s runs, %s\n' "$name" "${runs:-?}" "$coverage"
    [ -z "${ETALON_FUZZ_LOG:-}" ] || printf '%s %s\n' "$name" "$seconds" >>"$ETALON_FUZZ_LOG"
  else
    printf '[etalon] failed: fuzz %s: exit code %d after %s runs: %s\n  %s\n' "$name" "$status" "${runs:-?}" \
      "$(grep -a -m 1 -E 'SUMMARY|ERROR|a refusal of another form|not as promised' "$work/log")" "$(grep -a -m 1 'Test unit written to' "$work/log"), log $work/log"
  fi
}

results=$(mktemp) || exit 4
trap 'rm -f "$results"' EXIT
for name in "${names[@]}"; do
  while [ "$(jobs -rp | wc -l)" -ge "$jobs" ]; do wait -n; done
  run_one "$name" >>"$results" &
done
wait
cat "$results"
passed=$(grep -c ': passed, ' "$results") failed=$(grep -c '^\[etalon\] failed: ' "$results") skipped=$(grep -c '^\[etalon\] skipped: ' "$results")
printf 'fuzz: %d passed, %d failed, %d skipped\n' "$passed" "$failed" "$skipped"
[ "$failed" -eq 0 ] || exit 2
