# Sourced by ./check: the readers and streams under clang's address and undefined-behaviour sanitizers, in a build of their own: their tests, then libFuzzer
# on each of them from the seeds of the tree (tests/fuzz).

sanitized="$root/build/sanitized"
sanitized_suites=(streams io progressive terrain wavelet joint draw)
export LSAN_OPTIONS="suppressions=$root/tests/support/lsan.supp:print_suppressions=0" UBSAN_OPTIONS=print_stacktrace=1

# build_sanitized: false where there is no clang; that is counted.
build_sanitized() {
  mkdir -p "$sanitized"
  if ! echo 'extern "C" int LLVMFuzzerTestOneInput(const char*, unsigned long) { return 0; }' |
    clang++ -x c++ -fsanitize=fuzzer,address,undefined -o "$sanitized/probe" - >/dev/null 2>&1; then
    count 0 0 1
    printf '[etalon] skipped: sanitizers and fuzzing: no clang that links libFuzzer and the sanitizers\n'
    return 1
  fi
  configure "$sanitized" --preset fuzz -DETALON_GPU=OFF -DETALON_WERROR=OFF
  build "$sanitized" etalon_fuzz $(printf 'etalon_%s_tests ' "${sanitized_suites[@]}")
}

# check_fuzz SECONDS: of each target; `fuzz.sh` ends with its sums.
check_fuzz() {
  local log="$root/build/fuzz.log" sums
  say "fuzz: $1 s each"
  "$root/tests/fuzz/fuzz.sh" "$sanitized" "$1" | tee "$log" | grep '^\[etalon\]'
  sums=$(sed -n 's/^fuzz: \([0-9]*\) passed, \([0-9]*\) failed, \([0-9]*\) skipped$/\1 \2 \3/p' "$log")
  # shellcheck disable=SC2086 # three numbers
  if [ -n "$sums" ]; then count $sums; else count 0 1 0; printf '[etalon] failed: fuzz: it ended early\n'; fi
  say "fuzz: passed, failed, skipped ${sums:-0 1 0}; the lines are in $log, inputs of findings in ${sanitized#"$root"/}/fuzz/findings"
}

check_sanitized() {
  local pattern
  build_sanitized || return 0
  pattern=$(IFS='|'; printf '%s' "${sanitized_suites[*]}")
  # The long tests, and those of real inputs, run without sanitizers: damaged copies of a whole model take ten minutes here.
  ETALON_FULL='' ETALON_DATA='' check_tests sanitized "$root/build/sanitized.log" ctest --test-dir "$sanitized" -R "^($pattern)\$"
  check_fuzz 20
}
