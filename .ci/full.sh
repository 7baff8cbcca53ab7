# Sourced by ./check --full: the long steps. One that failed nothing is recorded in build/full-state under the state of the sources and not run again.

state_file="$root/build/full-state"
state_key=$({ git -C "$root" rev-parse 'HEAD^{tree}' && git -C "$root" diff HEAD && git -C "$root" ls-files --others --exclude-standard; } 2>/dev/null | sha256sum | cut -c1-16)
say "full: state $state_key in $state_file"

# full_step NAME FUNCTION ARGUMENT…: runs it unless it is recorded, adds what it counted.
full_step() {
  local name=$1 before_passed=$passed before_failed=$failed before_skipped=$skipped recorded
  shift
  recorded=$(awk -F'\t' -v key="$state_key" -v name="$name" '$1 == key && $2 == name { print $3 }' "$state_file" 2>/dev/null | tail -n 1)
  if [ -n "$recorded" ]; then
    say "full: $name: done before: $recorded"
    # shellcheck disable=SC2086 # three numbers
    count $recorded
    return 0
  fi
  say "full: $name"
  "$@"
  [ "$failed" -gt "$before_failed" ] && return 0
  printf '%s\t%s\t%d %d %d\n' "$state_key" "$name" $((passed - before_passed)) 0 $((skipped - before_skipped)) >>"$state_file"
}

# A long program of the tree that is a check as a whole; its output stays visible.
full_program() {
  local status=0
  "$@" || status=$?
  case $status in
    0) count 1 0 0 ;;
    1) count 0 0 1; printf '[etalon] skipped: %s: ended with a warning (exit code 1)\n' "${1##*/}" ;;
    *) count 0 1 0; printf '[etalon] failed: %s: exit code %d\n' "${1##*/}" "$status" ;;
  esac
}

# A preset of CMakePresets.json: configured, built and tested as a developer would.
full_preset() {
  local preset=$1 needs=$2 log="$root/build/full-$1.log"
  if ! command -v "$needs" >/dev/null 2>&1; then
    count 0 0 1
    printf '[etalon] skipped: preset %s: %s is not installed\n' "$preset" "$needs"
    return 0
  fi
  local launcher=()
  command -v ccache >/dev/null 2>&1 && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  if ! (cd "$root" && cmake --preset "$preset" "${launcher[@]}" && cmake --build --preset "$preset") >"$log" 2>&1; then
    tail -n 30 "$log"
    count 0 1 0
    printf '[etalon] failed: preset %s does not build; the whole log is %s\n' "$preset" "$log"
    return 0
  fi
  # tidy's build was its test.
  if [ "$preset" = tidy ]; then count 1 0 0; return 0; fi
  cd "$root" || return 1
  # The long tests ran once already; here the quick ones run under another compiler or a sanitizer.
  ETALON_FULL='' check_tests "preset $preset" "$log.tests" ctest --preset "$preset"
}

# A million mutants of .epm files and of terrain, texture and joint streams under the sanitizers, in the build of that preset.
full_mutants() {
  local folder program
  for folder in progressive terrain wavelet joint; do
    program="$root/build-asan-ubsan/tests/$folder/etalon_${folder}_tests"
    if [ ! -x "$program" ]; then
      count 0 0 1
      printf '[etalon] skipped: mutants of tests/%s: the preset asan-ubsan was not built\n' "$folder"
      continue
    fi
    full_program env ETALON_FULL=1 UBSAN_OPTIONS=halt_on_error=1 "$program" --test-case='*mutants are refused*,changed files*'
  done
}

# Mutants of the real files through `etalon info`.
full_info_mutants() {
  if [ ! -d "${ETALON_DATA:-}" ]; then
    count 0 0 1
    printf '[etalon] skipped: mutants of real files: no $ETALON_DATA\n'
    return 0
  fi
  local files
  mapfile -t files < <(find "$ETALON_DATA/" -type f -size +5k | LC_ALL=C sort)
  full_program "$root/build/tests/fuzz/etalon_info_mutants" --count 10000 --keep "$root/build/findings" "${files[@]}"
}

# Ten minutes of libFuzzer each; targets that passed are in the log, so that it goes on within the step too.
full_fuzz() { ETALON_FUZZ_LOG="$root/build/full-fuzz-$state_key.log" check_fuzz 600; }

# The judge keeps a log of finished blocks, so that it goes on within a step too.
judge="$root/build/tests/validation/reference/etalon_judge"
[ -x "$judge" ] && full_step judge full_program "$judge" --full --log "$root/build/full-judge-$state_key.log"
crosscheck="$root/build/tests/validation/etalon_crosscheck"
[ -x "$crosscheck" ] && full_step crosscheck full_program "$crosscheck" 1000000000
full_step no-gpu full_preset no-gpu g++
full_step asan-ubsan full_preset asan-ubsan clang++
full_step mutants full_mutants
full_step info-mutants full_info_mutants
full_step kill-writes full_program "$root/tests/faults/kill_writes.sh" "$root/build/cli/etalon" 1000
[ -d "$sanitized/tests/fuzz" ] && full_step fuzz full_fuzz
full_step tsan full_preset tsan clang++
full_step tidy full_preset tidy clang-tidy
