#!/usr/bin/env bash
# draw_in_browser.sh EXAMPLES FOLDER CASE…: draws FOLDER/DRAWS with WebGL2 in headless Chromium (SwiftShader, so on the CPU) into FOLDER/NAME.png.
# CASE is DRAWS:DEFECT:NAME, DEFECT one of defects.js, "none" for a right drawing. EXAMPLES holds draws_webgl.js. Prints the device.
# Exit code: 0 all pictures are there; 1 there is no browser, or none with WebGL2 (says so); 2 the drawing failed.
set -eu
here=$(cd -P -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
examples=$1 folder=$2
shift 2
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || { echo "no Chromium here"; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

json_files() {  # every draws file of the cases, with the images beside it
  local stem
  printf '%s\n' "$@" | cut -d: -f1 | sort -u | while read -r draws; do
    stem=${draws%.draws}
    (cd "$folder" && ls "$draws" "$stem".[0-9]*.png)
  done | while read -r name; do
    printf '"%s": "' "$name"
    base64 -w0 "$folder/$name"
    printf '",\n'
  done
}

{
  printf '<!doctype html><meta charset="utf-8"><body><script>const files = {\n'
  json_files "$@"
  printf '};\nconst cases = [\n'
  printf '%s\n' "$@" | sed 's/^\([^:]*\):\([^:]*\):\([^:]*\)$/{draws: "\1", defect: "\2", name: "\3"},/'
  printf '];\n</script>\n'
  for script in "$examples/draws_webgl.js" "$here/defects.js" "$here/page.js"; do
    printf '<script>\n'
    cat "$script"
    printf '</script>\n'
  done
} >"$work/page.html"

timeout 900 "$browser" --headless --no-sandbox --disable-gpu-sandbox --use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader --disable-background-networking \
  --disable-component-update --disable-sync --no-first-run --user-data-dir="$work/profile" \
  --dump-dom "file://$work/page.html" >"$work/dom" 2>"$work/log" || { tail -n 5 "$work/log"; echo "Chromium failed"; exit 2; }
sed -n 's/^@error //p' "$work/dom"
if grep -q '^@error .*no WebGL2' "$work/dom"; then exit 1; fi
grep -q "^@end $#$" "$work/dom" || { tail -n 5 "$work/log" | cut -c1-200; echo "the page did not end"; exit 2; }
sed -n 's/^@device //p' "$work/dom"
for case in "$@"; do
  name=${case##*:}
  sed -n "s/^@$name //p" "$work/dom" | base64 -d >"$folder/$name.png"
done
