#!/usr/bin/env bash
# format_test.sh SOURCE: every tracked source is as clang-format 14 (Debian 12's) leaves it; other versions format differently.
# Exit code 0: all are; 1: some are not, each named; 77: no clang-format 14, or no git checkout, here.
set -u
cd "$1" || exit 1
skip() { echo "[etalon] skipped: format: $1"; exit 77; }

formatter=$(command -v clang-format-14 || command -v clang-format) || skip "clang-format 14 is not installed"
"$formatter" --version | grep -q ' version 14\.' || skip "$("$formatter" --version): the sources follow version 14"
git rev-parse --git-dir >/dev/null 2>&1 || skip "not a git checkout"

# One warning a place; the first names the file.
warnings=$(git ls-files '*.h' '*.cpp' | xargs -d '\n' "$formatter" --dry-run 2>&1)
[ -z "$warnings" ] && exit 0
printf '%s\n' "$warnings" | sed -n 's/^\([^:]*\):[0-9]*:[0-9]*: warning: code should be clang-formatted.*/\1/p' | uniq -c |
  sed 's/^ *\([0-9]*\) \(.*\)/[etalon] failed: format: \2: \1 places (clang-format -i)/'
exit 1
