#!/usr/bin/env bash
# judge_pictures.sh ETALON EXAMPLES FOLDER [--table] [MODEL.obj [ARGUMENT…]]: draws a model with WebGL2 in headless Chromium from FILE.draws, rightly and
# in each wrong way of defects.js, and has `etalon diff` judge every picture. FOLDER, which must be empty, keeps them.
# MODEL: the embedded head by default; ARGUMENTs are etalon render's (--texture IMG, --flip-v). A wrong drawing must fail and be named; a right one pass.
# --table: a Markdown table, with what idiff, compare and gm compare say of the same pair (docs/diff.md).
# Exit code: 0 all judged as they should be; 1 there is no browser with WebGL2; 2 a wrong judgement.
set -eu
here=$(cd -P -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
etalon=$(realpath -- "$1") examples=$(realpath -- "$2") folder=$3
shift 3
table=no
if [ "${1:-}" = --table ]; then table=yes; shift; fi
cd "$folder"
embedded=no
if [ $# -eq 0 ]; then
  embedded=yes
  "$etalon" make head --quiet -o head.obj
  set -- head.obj
fi
model=$1
shift
# SwiftShader states a grid of 1/16 and 4 bits of texel fraction, and takes them for nearest lookup; it filters in float32, so linear is held to 16.
device_of() { case $1 in *-linear) echo vulkan:4:16 ;; *) echo vulkan:4 ;; esac }

golden() {  # NAME VIEW FILTER SIZE [ARGUMENT…]
  local name=$1 view=$2 filter=$3 size=$4
  shift 4
  "$etalon" render "$@" --view "$view" --filter "$filter" --size "$size" --snap-bits 4 --write-draws "$name.draws" --margins --quiet -o "$name.exr"
}
cases=() expected=()
right() { cases+=("$1.draws:none:$1"); expected+=("-"); }
wrong() { cases+=("$1.draws:$2:$1-$2"); expected+=("$3"); }  # SCENE DEFECT WHAT THE DIAGNOSIS MUST SAY
for filter in nearest linear; do
  golden "fit-$filter" fit $filter 256 "$model" "$@"
  golden "side-$filter" 3/24 $filter 200x150 "$model" "$@"
  golden "below-$filter" 17/24 $filter 300x400 "$model" "$@"
  for scene in fit side below; do right "$scene-$filter"; done
done
if [ $embedded = yes ]; then
  # The texture repeated: u and v run from -0.4 to 2.3.
  awk '$1 == "vt" { printf "vt %.9g %.9g\n", 2.7 * $2 - 0.4, 2.7 * $3 - 0.4; next } { print }' "$model" >repeated.obj
  # Magnified, so that weights of the filter show.
  printf '{"schema": "etalon/view/1", "eye": [3, 1, 4], "target": [0.25, 0.35, 0.4], "up": [0, 1, 0], "tan_half_fov_y": 0.03, "near": 1, "far": 20, "width": 320, "height": 320}\n' >close.json
  # Partly magnified, partly not.
  sed 's/0\.03/0.06/' close.json >near.json
  golden near-nearest near.json nearest 300 "$model"
  right near-nearest
  wrong near-nearest stale_mips 'another mip level, of other content'
  for filter in nearest linear; do
    golden "repeated-$filter" fit $filter 256 repeated.obj
    golden "close-$filter" close.json $filter 320 "$model"
    for scene in repeated close; do right "$scene-$filter"; done
  done
  wrong repeated-nearest clamp 'Looks like wrap clamp '
  wrong repeated-linear mirror 'Looks like wrap mirrored_repeat '
  wrong close-linear weights_8 'of 8 bits '
  wrong close-linear weights_4 'of 4 bits '
fi
wrong fit-nearest half_texel 'Looks like texture coordinate shifted by +1/2 texel in u and v '
wrong side-linear half_texel_u 'Looks like texture coordinate shifted by -1/2 texel in u '
wrong fit-nearest linear 'Looks like filter linear '
wrong fit-linear nearest 'Looks like filter nearest '
wrong below-nearest v_flipped 'Looks like v flipped '
wrong below-linear upside_down 'Looks like picture upside down '
wrong fit-nearest mipmaps 'Looks like mip levels '
wrong below-nearest stale_mip 'Looks like mip levels '
wrong side-nearest stale_texture 'other content throughout, as of a stale texture'
wrong fit-nearest stale_region 'a part of it has other content'
wrong side-nearest geometry 'Looks like geometry shifted by +1/2 texel in x '
wrong fit-linear no_depth_test 'Looks like no depth test '
wrong fit-nearest red_blue 'Looks like red and blue exchanged '

status=0
"$here/draw_in_browser.sh" "$examples" . "${cases[@]}" || exit

of_other() {  # PROGRAM CODE: what its exit code says
  case $2 in
    0) printf 'passes' ;;
    1) if [ "$1" = idiff ]; then printf 'warns'; else printf 'fails'; fi ;;
    127) printf 'not here' ;;
    *) printf 'fails' ;;
  esac
}

if [ "$table" = yes ]; then
  printf '| picture | etalon diff | identical | rounding | tie | unbounded | unexplained | named | idiff | compare | compare -metric AE | gm compare |\n'
  printf '|---|---|--:|--:|--:|--:|--:|---|---|---|---|---|\n'
fi
for n in "${!cases[@]}"; do
  IFS=: read -r draws defect name <<<"${cases[$n]}"
  scene=${draws%.draws} code=0
  device=$(device_of "$scene")
  said=$("$etalon" diff "$scene.exr" "$name.png" --device $device --json "$name.json" --threads 2 2>&1) || code=$?
  verdict=wrong
  if [ "$defect" = none ] && [ $code -eq 0 ]; then verdict=right; fi
  if [ "$defect" != none ] && [ $code -eq 2 ] && printf '%s' "$said" | grep -qF -- "${expected[$n]}"; then verdict=right; fi
  counts=$(printf '%s\n' "$said" | sed -n 's/^  identical \([0-9,]*\), rounding \([0-9,]*\), tie \([0-9,]*\), tie? 0, unbounded \([0-9,]*\), unexplained \([0-9,]*\)$/\1 | \2 | \3 | \4 | \5/p')
  named=$(printf '%s\n' "$said" | sed -n 's/.*Looks like \([^(]*\) (explains \([0-9.]* %\) of them).*/\1, \2/p')
  [ -n "$named" ] || named=$(printf '%s\n' "$said" | sed -n 's/.*No usual mistake explains them\. *\(Pattern: \)\{0,1\}\(.*\)$/\2/p')
  if [ "$table" = yes ]; then
    "$etalon" render "$draws" --quiet -o "$scene.golden.png"
    codes=()
    for program in "idiff" "compare" "compare -metric AE" "gm compare"; do
      code_of=0
      # shellcheck disable=SC2086 # a program and its options
      if [ "${program%% *}" = compare ]; then $program "$scene.golden.png" "$name.png" null: >/dev/null 2>&1 || code_of=$?
      else $program "$scene.golden.png" "$name.png" >/dev/null 2>&1 || code_of=$?; fi
      codes+=("$(of_other "${program%% *}" $code_of)")
    done
    word="$([ $code -eq 0 ] && echo passes || echo fails), $device"
    printf '| %s, %s | %s | %s | %s | %s | %s | %s | %s |\n' "$scene" "$defect" "$word" "$counts" "${named:-–}" "${codes[@]}"
  else
    printf '%s %s %s: %s\n' "$verdict" "$scene" "$defect" "$counts"
  fi
  if [ "$verdict" = wrong ]; then
    printf '[etalon] failed: WebGL: %s, %s: exit code %d, expected %s; it says: %s\n' "$scene" "$defect" "$code" "${expected[$n]}" "$said" >&2
    status=2
  fi
done
exit $status
