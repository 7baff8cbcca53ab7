#!/usr/bin/env bash
# format_test.sh SOURCE: every tracked source is as clang-format 14 (Debian 12's) leaves it; other versions format differently.
# Exit code 0: all are; 1: some are not, each named; 77: no clang-format 14, or no git checkout, here.
set -u
cd "$1" || exit 1
skip() { echo "[etalon] skipped: format: $1"; exit 77; }

formatter=$(command -v clang-format-14 || command -v clang-format) || skip "clang-format 14 is not installed"
"$formatter" --version | grep -q ' version 14\.' || skip "$("$formatter" --version): the sources follow version 14"
git rev-parse --git-dir >/dev/null 2>&1 || skip "not a git checkout"

bad=0
while IFS= read -r file; do
  "$formatter" --dry-run -Werror "$file" >/dev/null 2>&1 && continue
  echo "[etalon] failed: format: $file (clang-format -i)"
  bad=1
done < <(git ls-files '*.h' '*.cpp')
exit "$bad"
