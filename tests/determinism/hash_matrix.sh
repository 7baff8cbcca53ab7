#!/usr/bin/env bash
# hash_matrix.sh SOURCE BUILD PROGRAM: the same bytes for every compiler, optimisation, thread count and SIMD level.
# PROGRAM is etalon_hash_scenes as BUILD made it; it draws the fixed scenes of the self-test. Each build also does the jobs (hash_jobs.cpp). It is built again by g++ at -O0; with
# ETALON_FULL set by g++ and clang++ at -O0, -O2, -O3, with link-time optimisation, for the machine's own instructions, and with the
# contraction that the kernels of the fast path allow forbidden. One build breaks the rules on purpose (-ffast-math) and must differ: the
# matrix can see it. (Contraction everywhere, also forbidden, does not change these scenes: their bounds and exact stages take it.)
# Writes BUILD/hash_matrix.csv (a line a drawing) and BUILD/hash_matrix.md (a line a build), and prints the latter.
# With ETALON_FULL a build is neither made nor drawn again while its sources, compiler and options are those of its last time.
# Exit code 0: one hash, the golden one; 1: another or more than one, or a build failed; 64: usage.
# The golden hash changes only with kRasterContractVersion (or with the scenes), and a line in CHANGELOG.md.
set -u
if [ $# -ne 3 ]; then echo "usage: hash_matrix.sh SOURCE BUILD PROGRAM"; exit 64; fi
mkdir -p "$2/hash_matrix" || exit 64
source_dir=$(cd -- "$1" && pwd) build_dir=$(cd -- "$2" && pwd) program=$3  # builds run in folders of their own
work="$build_dir/hash_matrix"
launcher=$(command -v ccache || true)
golden=$(head -n 1 "$source_dir/data/golden/hash_scenes.sha256" | cut -d' ' -f1)
failed=0

# What the drawings depend on.
source_key=$(cd "$source_dir" && find CMakeLists.txt cmake core/base core/math core/image core/mesh core/draw core/procedural core/simplify core/progressive core/adapt core/bake raster validation/selftest \
  tests/determinism -type f ! -name hash_matrix.sh -print0 | sort -z | xargs -0 sha256sum | sha256sum | cut -c1-16)

rows="$work/rows.tsv"  # build, expectation (same or differs), evaluation, level, threads, hash
: >"$rows"

slug() { printf '%s' "$1" | tr -c 'A-Za-z0-9+' _; }

# draw NAME EXPECTATION PROGRAM KEY: its rows, from the last time where the key is the same; an empty key is never the same.
draw() {
  local name=$1 expectation=$2 drawn threads=1,2,7 evaluation level count hash
  drawn="$work/$(slug "$name").drawn"
  [ -z "${ETALON_FULL-}" ] || threads=1,2,7,16
  [ "$name" != "g++ -O0" ] || [ -n "${ETALON_FULL-}" ] || threads=2
  if [ -z "$4" ] || [ "$(head -n 1 "$drawn" 2>/dev/null)" != "$4" ]; then
    { echo "$4"; "$3" --threads "$threads" && { [ -z "${ETALON_FULL-}" ] || "$3" --evaluation exact --threads 2; }; } >"$drawn.part" ||
      { echo "[etalon] failed: hash_matrix $name: drawing ended with another exit code than 0"; failed=1; return; }
    mv "$drawn.part" "$drawn"
  fi
  while read -r evaluation level count hash; do
    printf '%s\t%s\t%s\t%s\t%s\t%s\n' "$name" "$expectation" "$evaluation" "$level" "$count" "$hash" >>"$rows"
  done < <(tail -n +2 "$drawn")
}

# do_jobs NAME PROGRAM: the jobs on built-in models, where a build is new.
do_jobs() {
  "$2" --threads 1,2,7 --golden "$source_dir/data/golden/hash_jobs.sha256" >"$work/jobs.txt" && return
  cat "$work/jobs.txt"
  echo "[etalon] failed: hash_matrix $1: a job differs from data/golden/hash_jobs.sha256"
  failed=1
  return 1
}

# build_and_draw EXPECTATION COMPILER OPTIONS [-DNAME=VALUE…]: OPTIONS are words for a person, compiler flags among them.
build_and_draw() {
  local expectation=$1 compiler=$2 options=$3 flags="" word
  shift 3
  for word in $options; do case $word in -*) flags+="$word " ;; esac done
  local name="$compiler $options" dir
  dir="$work/$(slug "$name")"
  if ! command -v "$compiler" >/dev/null 2>&1; then
    echo "[etalon] skipped: hash_matrix $name: $compiler is not installed"
    return
  fi
  local key=""
  [ -z "${ETALON_FULL-}" ] || key=$(printf '%s\n' "$source_key" "$name" "$@" "$("$compiler" --version)" "$(grep -m1 '^flags' /proc/cpuinfo)" | sha256sum | cut -c1-16)
  if [ -z "$key" ] || [ "$(head -n 1 "$dir.drawn" 2>/dev/null)" != "$key" ]; then
    # The build type is None, so that the flags are these and no others; asserts stay on.
    { cmake -S "$source_dir" -B "$dir" -G Ninja -DCMAKE_CXX_COMPILER_LAUNCHER="$launcher" -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_COMPILER="$compiler" \
        -DCMAKE_CXX_FLAGS="${flags% }" -DETALON_IO=OFF -DETALON_GPU=OFF -DETALON_CLI=OFF -DETALON_TESTS=ON "$@" &&
      ninja -C "$dir" -j "$(nproc)" etalon_hash_scenes etalon_hash_jobs; } >"$dir.log" 2>&1 ||
      { tail -n 20 "$dir.log"; echo "[etalon] failed: hash_matrix $name does not build"; failed=1; return; }
    [ "$expectation" = differs ] || do_jobs "$name" "$dir/tests/determinism/etalon_hash_jobs" || return
  fi
  draw "$name" "$expectation" "$dir/tests/determinism/etalon_hash_scenes" "$key"
}

# A launcher may be a list.
with_flag() { printf -- '-DCMAKE_CXX_COMPILER_LAUNCHER=%s;%s' "$source_dir/tests/determinism/with_flag.sh;$1" "$launcher"; }

draw "this build" same "$program" ""
if [ -n "${ETALON_FULL-}" ]; then
  for compiler in g++ clang++; do
    lto=(-DCMAKE_INTERPROCEDURAL_OPTIMIZATION=ON)
    [ "$compiler" = g++ ] || lto+=(-DCMAKE_EXE_LINKER_FLAGS=-fuse-ld=lld)
    build_and_draw same "$compiler" "-O2"
    build_and_draw same "$compiler" "-O3"
    build_and_draw same "$compiler" "-O2 LTO" "${lto[@]}"
    build_and_draw same "$compiler" "-O2 -march=native"
    build_and_draw same "$compiler" "-O3 -march=native LTO" "${lto[@]}"
    build_and_draw same "$compiler" "-O2 no contraction at all" "$(with_flag -ffp-contract=off)"
    build_and_draw same "$compiler" "-O3 -march=native no contraction at all" "$(with_flag -ffp-contract=off)"
  done
  build_and_draw differs g++ "-O2 fast-math everywhere" "$(with_flag -ffast-math)"
  build_and_draw same clang++ "-O0"
fi
build_and_draw same g++ "-O0"

awk -F'\t' -v golden="$golden" -v csv="$build_dir/hash_matrix.csv" '
  BEGIN { print "build,evaluation,level,threads,sha256,verdict" >csv }
  {
    verdict = $6 == golden ? "same" : "differs"
    printf "%s,%s,%s,%s,%s,%s\n", $1, $3, $4, $5, $6, verdict >csv
    if (!($1 in runs)) { order[++builds] = $1; expected[$1] = $2; hash[$1] = $6 }
    ++runs[$1]
    if ($6 != golden) ++other[$1]
    if ($6 != hash[$1]) hash[$1] = "several"
    if ($3 == "vectorised" && !index(" " levels[$1] " ", " " $4 " ")) levels[$1] = levels[$1] (levels[$1] == "" ? "" : " ") $4
    if (!index(" " threads[$1] " ", " " $5 " ")) threads[$1] = threads[$1] (threads[$1] == "" ? "" : " ") $5
  }
  END {
    print "| compiler, options | SIMD levels | threads | drawings | sha256 | |"
    print "|---|---|---|---|---|---|"
    for (n = 1; n <= builds; ++n) {
      b = order[n]
      wanted = (expected[b] == "differs") == (other[b] > 0)
      if (!wanted) bad = 1
      word = (other[b] ? "differs" : "same") (wanted ? (other[b] ? ", as it must" : "") : ": WRONG")
      printf "| %s | %s | %s | %d | `%s` | %s |\n", b, levels[b], threads[b], runs[b], substr(hash[b], 1, 16), word
      if (expected[b] == "same") all += runs[b]
    }
    if (bad) exit 1
    printf "%d\n", all >"/dev/stderr"
  }' "$rows" >"$build_dir/hash_matrix.md" 2>"$work/count" || failed=1
cat "$build_dir/hash_matrix.md"
if [ "$failed" -ne 0 ]; then
  echo "[etalon] failed: hash_matrix: expected one hash, the golden $golden (data/golden/hash_scenes.sha256); see $build_dir/hash_matrix.csv"
  exit 1
fi
echo "hash_matrix: $(cat "$work/count") drawings, one hash, the golden one: $golden"
