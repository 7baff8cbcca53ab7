#!/usr/bin/env bash
# machines.sh SOURCE BUILD [MACHINE…]: the same bytes on other processors. MACHINE: x86_64, aarch64, s390x (big-endian); all three by default.
# Crosses the core, the rasterizer and the judge with Debian's compilers (g++-aarch64-linux-gnu, g++-s390x-linux-gnu) against that processor's
# own Debian packages, unpacked into a folder of BUILD (nothing is installed), and runs under qemu-user: the fixed scenes of the self-test, the
# four jobs on built-in models, and the judge's quick suites. Hours on few cores; a machine is not done again while its sources, compiler and
# emulator are those of its last time.
# Writes BUILD/machines/machines.md (a line a machine) and prints it.
# Exit code 0: one hash, the golden one, on all that could be run; 1: another, or something failed; 64: usage; 77: nothing could be run.
set -u
if [ $# -lt 2 ]; then sed -n '2s/^# //p' "$0"; exit 64; fi
source_dir=$(cd -- "$1" && pwd) || exit 64
mkdir -p "$2/machines" || exit 64
work=$(cd -- "$2/machines" && pwd)
shift 2
[ $# -gt 0 ] || set -- x86_64 aarch64 s390x
for machine in "$@"; do
  case $machine in x86_64 | aarch64 | s390x) ;; *) echo "machines.sh: unknown machine $machine; expected x86_64, aarch64 or s390x"; exit 64 ;; esac
done
launcher=$(command -v ccache || true)
golden=$(head -n 1 "$source_dir/data/golden/hash_scenes.sha256" | cut -d' ' -f1)
source_key=$(cd "$source_dir" && find CMakeLists.txt cmake core raster validation/reference validation/selftest tests/determinism data/golden \
  -type f -print0 | sort -z | xargs -0 sha256sum | sha256sum | cut -c1-16)
failed=0 ran=0

debian_name() { case $1 in aarch64) echo arm64 ;; *) echo "$1" ;; esac; }

# get_packages MACHINE: what the build links, into $work/MACHINE/root.
get_packages() {
  local home=$work/$1 architecture
  architecture=$(debian_name "$1")
  [ ! -e "$home/root/.complete" ] || return 0
  rm -rf "$home/root" && mkdir -p "$home/root" "$home/apt/lists/partial" "$home/apt/archives/partial" && : >"$home/apt/status"
  local options=(-o "APT::Architecture=$architecture" -o "APT::Architectures=$architecture" -o "Dir::State=$home/apt" -o "Dir::State::status=$home/apt/status"
    -o "Dir::Cache=$home/apt" -o "Dir::State::lists=$home/apt/lists")
  apt-get "${options[@]}" update &&
    (cd "$home/apt/archives" && apt-get "${options[@]}" download libfmt-dev libfmt9 libglm-dev libhwy-dev libhwy1 libtbb-dev libtbb12 libtbbmalloc2 libtbbbind-2-5 \
      nlohmann-json3-dev libboost1.74-dev libboost-dev doctest-dev) || return 1
  local package
  for package in "$home"/apt/archives/*.deb; do dpkg-deb -x "$package" "$home/root" || return 1; done
  : >"$home/root/.complete"
}

write_toolchain() {
  cat >"$work/$1/toolchain.cmake" <<END
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR $1)
set(CMAKE_CXX_COMPILER $1-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE $1-linux-gnu)
set(CMAKE_FIND_ROOT_PATH "$work/$1/root")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(CMAKE_EXE_LINKER_FLAGS "-Wl,--allow-shlib-undefined")
END
}

# emulated MACHINE PROGRAM ARGUMENT…
emulated() {
  local machine=$1
  shift
  if [ "$machine" = "$(uname -m)" ]; then "$@"; return; fi
  "qemu-$machine" -L "/usr/$machine-linux-gnu" -E "LD_LIBRARY_PATH=$work/$machine/root/usr/lib/$machine-linux-gnu" "$@"
}

skip() { echo "[etalon] skipped: machines $1: $2"; }
fail() { echo "[etalon] failed: machines $1: $2"; failed=1; }

for machine in "$@"; do
  home=$work/$machine
  mkdir -p "$home" || exit 64
  cross=()
  if [ "$machine" != "$(uname -m)" ]; then
    command -v "$machine-linux-gnu-g++" >/dev/null || { skip "$machine" "no cross compiler (Debian: g++-${machine/_/-}-linux-gnu)"; continue; }
    command -v "qemu-$machine" >/dev/null || { skip "$machine" "no emulator (Debian: qemu-user)"; continue; }
    echo "[etalon] machines $machine: packages"
    get_packages "$machine" >"$home/packages.log" 2>&1 || { tail -n 5 "$home/packages.log"; skip "$machine" "its packages could not be fetched"; continue; }
    write_toolchain "$machine"
    cross=(-DCMAKE_TOOLCHAIN_FILE="$home/toolchain.cmake")
    compiler=$machine-linux-gnu-g++ emulator=$("qemu-$machine" --version | sed -n '1s/.*version \([0-9.]*\).*/qemu-user \1/p')
  else
    compiler=g++ emulator="itself"
  fi
  ran=1
  key=$(printf '%s\n' "$source_key" "$("$compiler" --version)" "$emulator" | sha256sum | cut -c1-16)
  if [ "$(head -n 1 "$home/row" 2>/dev/null)" = "$key" ]; then echo "[etalon] machines $machine: as before"; continue; fi
  rm -f "$home/row"
  echo "[etalon] machines $machine: building"
  { cmake -S "$source_dir" -B "$home/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER_LAUNCHER="$launcher" "${cross[@]}" -DETALON_IO=OFF \
      -DETALON_GPU=OFF -DETALON_TESTS=ON &&
    ninja -C "$home/build" -j "$(nproc)" etalon_hash_scenes etalon_hash_jobs etalon_judge; } >"$home/build.log" 2>&1 ||
    { tail -n 20 "$home/build.log"; fail "$machine" "it does not build"; continue; }
  echo "[etalon] machines $machine: fixed scenes"
  emulated "$machine" "$home/build/tests/determinism/etalon_hash_scenes" --threads 1,7 --evaluation all >"$home/scenes.txt" 2>&1 ||
    { tail -n 5 "$home/scenes.txt"; fail "$machine" "drawing the fixed scenes"; continue; }
  echo "[etalon] machines $machine: jobs"
  emulated "$machine" "$home/build/tests/determinism/etalon_hash_jobs" --threads 1,7 --golden "$source_dir/data/golden/hash_jobs.sha256" >"$home/jobs.txt" 2>&1 ||
    { grep -A1 -E '^(expected|differs|nobody|etalon)' "$home/jobs.txt" | head -n 20; fail "$machine" "a job gives other bytes"; continue; }
  echo "[etalon] machines $machine: the judge"
  emulated "$machine" "$home/build/tests/validation/reference/etalon_judge" >"$home/judge.txt" 2>&1 ||
    { tail -n 5 "$home/judge.txt"; fail "$machine" "the judge disagrees"; continue; }
  hashes=$(cut -d' ' -f4 "$home/scenes.txt" | sort -u)
  [ "$hashes" = "$golden" ] || { fail "$machine" "the fixed scenes have the hashes $hashes instead of $golden"; continue; }
  order=$(case $machine in s390x) echo big ;; *) echo little ;; esac)
  { echo "$key"
    printf '| %s | %s | %s | %s | %s | %s | %s | `%s` |\n' "$machine" "$order" "$("$compiler" -dumpfullversion)" "$emulator" \
      "$(cut -d' ' -f2 "$home/scenes.txt" | sort -u | grep -v -x -e - | paste -sd' ')" "$(wc -l <"$home/scenes.txt")" \
      "$(grep -c '^[0-9a-f]\{64\}  ' "$home/jobs.txt")" "${golden:0:16}"; } >"$home/row"
done

{ echo "| machine | byte order | g++ | run by | SIMD levels | drawings of all scenes | results of jobs | sha256 of the scenes |"
  echo "|---|---|---|---|---|---|---|---|"
  for machine in "$@"; do [ ! -e "$work/$machine/row" ] || sed -n 2p "$work/$machine/row"; done; } >"$work/machines.md"
cat "$work/machines.md"
[ "$ran" = 1 ] || exit 77
exit "$failed"
