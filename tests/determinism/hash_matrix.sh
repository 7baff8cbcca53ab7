#!/usr/bin/env bash
# hash_matrix.sh SOURCE BUILD PROGRAM: the same bytes for every compiler, optimisation level and thread count.
# PROGRAM is etalon_hash_scenes as BUILD made it. It is built again by g++ at -O0; with ETALON_FULL set by g++ and
# clang++ at -O0, -O3, and -O2 -march=native.
# Exit code 0: one hash, the golden one; 1: another or more than one, each printed with who made it; 77: nothing to compare with.
# The golden hash changes only with kRasterContractVersion (or with the scenes), and a line in CHANGELOG.md.
set -u
source_dir=$1 build_dir=$2 program=$3

variants=("g++ -O0")
if [ -n "${ETALON_FULL-}" ]; then
  variants+=("g++ -O3" "g++ -O2 -march=native" "clang++ -O0" "clang++ -O3" "clang++ -O2 -march=native")
fi
launcher=()
command -v ccache >/dev/null 2>&1 && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)

rows=()
record() {  # record WHO PROGRAM
  local threads hash
  for threads in 1 2 7; do
    hash=$("$2" --threads "$threads") || hash="failed with exit code $?"
    rows+=("$hash  $1, $threads threads")
  done
}

record "this build" "$program"
for variant in "${variants[@]}"; do
  compiler=${variant%% *} flags=${variant#* }
  if ! command -v "$compiler" >/dev/null 2>&1; then
    echo "[etalon] skipped: hash_matrix $variant: $compiler is not installed"
    continue
  fi
  mkdir -p "$build_dir/hash_matrix"
  dir="$build_dir/hash_matrix/${variant//[^A-Za-z0-9+]/_}"
  # The build type is empty, so that the flags are these and no others; asserts stay on.
  { cmake -S "$source_dir" -B "$dir" -G Ninja "${launcher[@]}" -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS="$flags" \
      -DETALON_IO=OFF -DETALON_GPU=OFF -DETALON_CLI=OFF -DETALON_TESTS=ON &&
    ninja -C "$dir" etalon_hash_scenes; } >"$dir.log" 2>&1 || { tail -n 20 "$dir.log"; echo "[etalon] failed: hash_matrix $variant does not build"; exit 1; }
  record "$variant" "$dir/tests/determinism/etalon_hash_scenes"
done

printf '%s\n' "${rows[@]}"
distinct=$(printf '%s\n' "${rows[@]}" | cut -d' ' -f1 | sort -u | wc -l)
if [ "$distinct" -ne 1 ] || printf '%s\n' "${rows[@]}" | grep -q '^failed'; then
  echo "[etalon] failed: hash_matrix: $distinct different hashes"
  exit 1
fi
golden=$(cut -d' ' -f1 "$source_dir/data/golden/hash_scenes.sha256")
if [ "${rows[0]%% *}" != "$golden" ]; then
  echo "[etalon] failed: hash_matrix: expected the golden hash $golden (data/golden/hash_scenes.sha256)"
  exit 1
fi
echo "hash_matrix: ${#rows[@]} runs, one hash, the golden one"
