#!/usr/bin/env bash
# install_test.sh BUILD OUTSIDE EXAMPLE EXPECTED_PROGRAM COMPILER: installs BUILD under a temporary prefix; then the project in OUTSIDE, which knows
# nothing but that prefix, builds EXAMPLE and must print what EXPECTED_PROGRAM (the same source, built in the tree) prints.
set -eu
build=$1 outside=$2 example=$3 expected_program=$4 compiler=$5
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

quietly() { "$@" >"$work/log" 2>&1 || { tail -n 40 "$work/log"; echo "[etalon] failed: install: $*"; exit 1; }; }

quietly cmake --install "$build" --prefix "$work/prefix"
cp -r "$outside" "$work/outside"
cp "$example" "$work/outside/triangle.cpp"
(cd "$work/prefix/include/etalon" && find . -name '*.h' | sed 's|^\./|#include "|; s|$|"|' | sort) >"$work/outside/installed_headers.inc"
[ "$(wc -l <"$work/outside/installed_headers.inc")" -gt 20 ] || { echo "[etalon] failed: install: no headers installed"; exit 1; }
if grep -rqF "$(dirname "$build")" "$work/prefix/lib"*/cmake "$work/prefix/lib"*/*/cmake 2>/dev/null; then
  echo "[etalon] failed: install: the exported targets name the source tree"
  exit 1
fi

quietly cmake -S "$work/outside" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_PREFIX_PATH="$work/prefix"
quietly ninja -C "$work/build"
expected=$("$expected_program")
got=$("$work/build/triangle")
[ "$got" = "$expected" ] || { echo "[etalon] failed: install: expected $expected, got $got"; exit 1; }
echo "install: the outside project drew $got"
