#!/usr/bin/env bash
# ci_examples_test.sh ETALON EXAMPLES: the CTest snippet and the shell script of docs/examples/ci, as printed, on right, wrong and waived pictures.
set -eu
etalon=$1 examples=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() { echo "[etalon] failed: ci examples: $1"; sed -n 1,40p log 2>/dev/null || true; exit 2; }
expect() {  # CODE PROGRAM…
  local expected=$1 code=0
  shift
  "$@" >log 2>&1 || code=$?
  [ $code -eq "$expected" ] || fail "expected exit code $expected, got $code: $*"
}

mkdir golden wrong
"$etalon" make swirl --faces 200 --quiet -o swirl.obj
for name in sharp smooth; do
  filter=$([ $name = sharp ] && echo nearest || echo linear)
  "$etalon" render swirl.obj --size 48 --filter "$filter" --margins --quiet --write-draws golden/$name.draws -o golden/$name.exr
done
cat >draw.sh <<'EOF'
#!/bin/sh
exec "$ETALON" render "$1" --quiet -o "$2"
EOF
# A renderer that filters where it must not.
sed 's|"$1"|"$(dirname "$1")/smooth.draws"|' draw.sh >draw_smooth.sh
waiver() {  # PAIR: what is waived of it
  printf '{"schema": "etalon/waivers/1", "waivers": [{"pair": "%s", "device": "vulkan:8", "texels": 2304, "expires": "2099-12-31", "reason": "known"}]}\n' "$1"
}

cp "$examples/picture_tests.cmake" .
cat >CMakeLists.txt <<'EOF'
cmake_minimum_required(VERSION 3.22)
project(pictures NONE)
enable_testing()
include(picture_tests.cmake)
add_picture_test(sharp vulkan:8 sh "${CMAKE_SOURCE_DIR}/${PROGRAM}")
add_picture_test(smooth vulkan:8 sh "${CMAKE_SOURCE_DIR}/draw.sh")
EOF
export ETALON=$etalon
tests() { expect 0 cmake -S . -B build -DETALON="$etalon" -DPROGRAM="$1"; expect "$2" ctest --test-dir build; }
tests draw.sh 0
grep -q '100% tests passed.* out of 4' log || fail "four tests"
tests draw_smooth.sh 8
grep -q 'picture_sharp (Failed)' log || fail "picture_sharp fails"
grep -q '<failure ' build/sharp.xml || fail "JUnit names the failure"
grep -q 'filter linear' build/sharp.html || fail "the page names the cause"
waiver sharp.png >golden/sharp.waivers.json
tests draw_smooth.sh 0
tests draw.sh 8  # mended: the waiver covers nothing
rm golden/sharp.waivers.json

mkdir pictures
for name in sharp smooth; do sh draw.sh golden/$name.draws pictures/$name.png; done
expect 0 sh "$examples/judge_pictures.sh" golden pictures vulkan:8
sh draw_smooth.sh golden/sharp.draws pictures/sharp.png
expect 2 sh "$examples/judge_pictures.sh" golden pictures vulkan:8
grep -q 'failures="1"' pictures.xml || fail "one failure in pictures.xml"
[ -s pictures.html ] && [ -s pictures.json ] || fail "the page and the document"
waiver sharp.exr >golden/waivers.json
expect 0 sh "$examples/judge_pictures.sh" golden pictures vulkan:8
# The example of waivers is one.
expect 2 "$etalon" diff golden/smooth.exr pictures/smooth.png --device d3d11 --waivers "$examples/waivers.json"
grep -q 'covers nothing\|covered nothing\|unused' log || fail "an unused waiver is told"
echo "ci examples: the CTest snippet and the shell script judge right, wrong and waived pictures"
