#!/usr/bin/env bash
# diff_speed.sh ETALON [ROUNDS [SIZE | A.png B.png]]: the time of `etalon diff` against idiff's and `gm compare`'s for one pair of SIZE² texels (4096) that
# differ, in turns: etalon, idiff, gm, etalon, … (5 rounds). Prints medians and the medians of the quotients within a round. The pair: the embedded head by
# nearest and by linear lookup, as PNG (RGBA, 8 bits), so that texels differ everywhere on it; or the two given. Each program reads both files and
# compares all.
# Exit code: 0 measured; 1 neither rival is installed (packages openimageio-tools, graphicsmagick); 2 something went wrong.
set -eu
etalon=$(realpath -- "$1") rounds=${2:-5} size=${3:-4096}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if [ $# -eq 4 ]; then
  cp -- "$3" "$work/a.png"
  cp -- "$4" "$work/b.png"
  cd "$work"
else
  cd "$work"
  "$etalon" make head --quiet -o head.obj
  "$etalon" render head.obj --size "$size" --filter nearest --quiet -o a.png
  "$etalon" render head.obj --size "$size" --filter linear --quiet -o b.png
fi
rivals=()
command -v idiff >/dev/null && rivals+=("idiff")
command -v gm >/dev/null && rivals+=("gm compare -metric MAE")
[ ${#rivals[@]} -gt 0 ] || { echo "neither idiff nor gm is installed"; exit 1; }

timed() {  # FILE PROGRAM…: its wall time in ms, to FILE; both pictures are in the page cache
  local file=$1 begin end
  shift
  begin=$(date +%s%N)
  "$@" >/dev/null 2>&1 || true
  end=$(date +%s%N)
  echo $(((end - begin) / 1000)) >>"$file"
}
median() { sort -n "$1" | awk '{ v[NR] = $1 } END { print NR % 2 ? v[(NR + 1) / 2] : (v[NR / 2] + v[NR / 2 + 1]) / 2 }'; }

cat a.png b.png >/dev/null
for ((n = 0; n < rounds; ++n)); do
  timed ours "$etalon" diff a.png b.png
  for k in "${!rivals[@]}"; do
    # shellcheck disable=SC2086 # a program and its options
    timed "rival$k" ${rivals[$k]} a.png b.png
  done
done
printf 'PNG of %s and %s bytes, %d rounds, %d processors\n' "$(stat -c %s a.png)" "$(stat -c %s b.png)" "$rounds" "$(nproc)"
printf 'etalon diff: %.0f ms\n' "$(awk -v t="$(median ours)" 'BEGIN { print t / 1000 }')"
for k in "${!rivals[@]}"; do
  paste "rival$k" ours | awk '{ print $1 / $2 }' >"quotients$k"
  printf '%s: %.0f ms, %.2f times ours (%.2f to %.2f)\n' "${rivals[$k]}" "$(awk -v t="$(median "rival$k")" 'BEGIN { print t / 1000 }')" \
    "$(median "quotients$k")" "$(sort -n "quotients$k" | head -n 1)" "$(sort -n "quotients$k" | tail -n 1)"
done
