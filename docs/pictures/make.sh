#!/usr/bin/env bash
# Makes the README's pictures. first-check.png: the exact rasterizer | OpenGL | the class of every texel, of `etalon verify` on the built-in head.
# swirl.png: full mesh | simplified | the same with its texture adapted, of `etalon study chen`.
# Usage: docs/pictures/make.sh [ETALON]   (default build/cli/etalon; needs oiiotool, which ./run installs, and OpenGL)
set -eu
cd -P -- "$(dirname -- "${BASH_SOURCE[0]}")/../.."
etalon=${1:-build/cli/etalon}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$etalon" verify --jobs render --view fit --report "$work/report" --quiet
# The page holds its pictures as data URIs; the first of each kind belongs to the head, nearest.
for kind in cpu gl classes; do
  grep -o "<img class=\"$kind\"[^>]*" "$work/report/index.html" | head -n 1 | sed 's/.*base64,//; s/".*//' | base64 -d >"$work/$kind.png"
done
for kind in cpu gl classes; do
  oiiotool "$work/$kind.png" --ch R,G,B --cut 640x800+190+100 --resize 400x500 -o "$work/$kind-small.png"
done
# Each with a gutter of white on its right, side by side, less the last gutter.
for kind in cpu gl classes; do
  oiiotool "$work/$kind-small.png" --create 408x500 3 --fill:color=1,1,1 408x500 --paste +0+0 -o "$work/$kind-guttered.png"
done
oiiotool "$work/cpu-guttered.png" "$work/gl-guttered.png" "$work/classes-guttered.png" --mosaic 3x1 --cut 1216x500+0+0 -d uint8 \
  -o docs/pictures/first-check.png

"$etalon" study chen swirl --report "$work/swirl" --quiet
oiiotool "$work/swirl/swirl-colour-original.png" "$work/swirl/swirl-colour-399-qem5.png" "$work/swirl/swirl-colour-399-map.png" --mosaic 3x1 \
  --resize 1080x360 -d uint8 -o docs/pictures/swirl.png
