// Draws `cases` ([{draws, defect, name}]) from `files` (name: base64) and leaves each picture as a base64 PNG in the document.
"use strict";

const decoded = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));

function encoded(bytes) {
  let text = "";
  for (let i = 0; i < bytes.length; i += 8192) text += String.fromCharCode(...bytes.subarray(i, i + 8192));
  return btoa(text);
}

function leave(name, text) {
  document.body.append(`\n@${name} ${text}\n`);
}

function flipped(rgba, width, height) {
  const result = new Uint8Array(rgba.length);
  for (let y = 0; y < height; ++y) result.set(rgba.subarray(4 * width * y, 4 * width * (y + 1)), 4 * width * (height - 1 - y));
  return result;
}

function main() {
  const gl = document.createElement("canvas").getContext("webgl2", {antialias: false});
  if (!gl) throw new Error("no WebGL2");
  leave("device", deviceName(gl));
  const pictures = {};
  for (const {draws, defect, name} of cases) {
    const scene = readDraws(decoded(files[draws])), images = [];
    for (const {path} of scene.header.images || []) {
      pictures[path] = pictures[path] || decodePng(decoded(files[path]));
      images.push(pictures[path]);
    }
    const wrong = defects[defect](scene, images), {width, height} = scene.header.frame;
    let rgba = drawScene(gl, scene, images, wrong);
    if (wrong.flip) rgba = flipped(rgba, width, height);
    if (wrong.swap) for (let i = 0; i < rgba.length; i += 4) [rgba[i], rgba[i + 2]] = [rgba[i + 2], rgba[i]];
    leave(name, encoded(encodePng(width, height, rgba)));
  }
  leave("end", `${cases.length}`);
}

try {
  main();
} catch (error) {
  leave("error", error.stack.replace(/\n/g, " | "));
}
