// Draws a FILE.draws with WebGL2 and hands the picture out as a PNG, without etalon: what another pipeline does whose pictures `etalon diff`
// shall judge. For a page that brings the files' bytes itself; tests/webgl runs it in a browser. docs/formats.md#draws
"use strict";

// {header, draws: [{..., first: byte offsets}]}: the header, and of each draw its vertices (10 words each) and triangles.
function readDraws(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (new TextDecoder().decode(bytes.subarray(0, 8)) !== "etalonDR") throw new Error("not a FILE.draws");
  const size = Number(view.getBigUint64(8, true));
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(16, 16 + size)));
  const vertices = [], ranges = [];
  let at = 16 + size;
  for (const draw of header.draws) {
    for (let i = 0; i < draw.vertices; ++i, at += 40) {
      const word = (k) => view.getFloat32(at + 4 * k, true), whole = (k) => view.getInt32(at + 4 * k, true);
      const raster = draw.space === "raster";
      vertices.push({x: raster ? whole(0) : word(0), y: raster ? whole(1) : word(1), z: word(2), w: word(3),
                     uv: [word(4), word(5)], color: [word(6), word(7), word(8), word(9)]});
    }
    const indices = new Uint32Array(3 * draw.triangles);
    for (let i = 0; i < indices.length; ++i, at += 4) indices[i] = view.getUint32(at, true);
    ranges.push(indices);
  }
  if (at !== bytes.length) throw new Error(`the arrays end at ${at}, the file at ${bytes.length}`);
  return {header, vertices, indices: ranges};
}

// Deflate data in zlib's wrapper, `size` bytes when unpacked [RFC 1950, 1951]. At once, so that a page can be read as soon as it is loaded.
function inflate(input, size) {
  const output = new Uint8Array(size);
  let at = 2, to = 0, held = 0, count = 0;
  const bits = (n) => {
    while (count < n) held |= input[at++] << count, count += 8;
    const value = held & ((1 << n) - 1);
    held >>>= n, count -= n;
    return value;
  };
  const codes = (lengths) => {  // canonical Huffman: how many codes of each length, and their symbols in order
    const counts = new Uint16Array(16), symbols = [];
    for (const length of lengths) ++counts[length];
    counts[0] = 0;
    for (let length = 1; length < 16; ++length) lengths.forEach((l, symbol) => l === length && symbols.push(symbol));
    return {counts, symbols};
  };
  const symbol = ({counts, symbols}) => {
    for (let length = 1, code = 0, first = 0, index = 0; length < 16; ++length) {
      code |= bits(1);
      if (code - first < counts[length]) return symbols[index + code - first];
      index += counts[length], first = (first + counts[length]) << 1, code <<= 1;
    }
    throw new Error("bad Huffman code");
  };
  const fixed = [codes(Array.from({length: 288}, (_, i) => (i < 144 ? 8 : i < 256 ? 9 : i < 280 ? 7 : 8))), codes(Array(30).fill(5))];
  const dynamic = () => {
    const literals = 257 + bits(5), distances = 1 + bits(5), lengths = Array(19).fill(0);
    for (let i = 0, n = 4 + bits(4); i < n; ++i) lengths[[16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15][i]] = bits(3);
    const meta = codes(lengths), all = [];
    while (all.length < literals + distances) {
      const s = symbol(meta);
      if (s < 16) all.push(s);
      else all.push(...Array(s === 16 ? 3 + bits(2) : s === 17 ? 3 + bits(3) : 11 + bits(7)).fill(s === 16 ? all[all.length - 1] : 0));
    }
    return [codes(all.slice(0, literals)), codes(all.slice(literals))];
  };
  for (let last = 0; !last;) {
    last = bits(1);
    const type = bits(2);
    if (type === 0) {
      const size = input[(at -= count >> 3)] | (input[at + 1] << 8);
      held = count = 0;
      output.set(input.subarray(at + 4, at + 4 + size), to);
      at += 4 + size, to += size;
      continue;
    }
    const [literal, distance] = type === 1 ? fixed : dynamic();
    for (let s; (s = symbol(literal)) !== 256;) {
      if (s < 256) {
        output[to++] = s;
        continue;
      }
      const l = s - 257, extra = l < 8 || l === 28 ? 0 : (l >> 2) - 1;
      const length = l === 28 ? 258 : l < 8 ? l + 3 : ((4 + (l & 3)) << extra) + 3 + bits(extra);
      const d = symbol(distance), more = d < 4 ? 0 : (d >> 1) - 1, back = d < 4 ? d + 1 : ((2 + (d & 1)) << more) + 1 + bits(more);
      for (let k = 0; k < length; ++k, ++to) output[to] = output[to - back];
    }
  }
  return output;
}

// The same unpacked: blocks that are stored as they are.
function deflateStored(bytes) {
  const blocks = Math.max(1, Math.ceil(bytes.length / 65535)), output = new Uint8Array(2 + bytes.length + 5 * blocks + 4);
  output.set([0x78, 0x01]);
  let to = 2, a = 1, b = 0;
  for (let k = 0; k < blocks; ++k) {
    const part = bytes.subarray(65535 * k, 65535 * (k + 1)), n = part.length;
    output.set([k === blocks - 1 ? 1 : 0, n & 255, n >> 8, ~n & 255, (~n >> 8) & 255], to);
    output.set(part, to + 5);
    to += 5 + n;
  }
  for (const byte of bytes) a = (a + byte) % 65521, b = (b + a) % 65521;
  output.set([b >> 8, b & 255, a >> 8, a & 255], to);
  return output;
}

function joined(parts) {
  const bytes = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) bytes.set(part, at), (at += part.length);
  return bytes;
}

// 8-bit PNG, not interlaced: {width, height, channels, texels}, the highest row first. The browser's own decoder may change colours.
function decodePng(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const parts = [];
  let width = 0, height = 0, channels = 0;
  for (let at = 8; at < bytes.length;) {
    const size = view.getUint32(at), name = String.fromCharCode(...bytes.subarray(at + 4, at + 8)), data = bytes.subarray(at + 8, at + 8 + size);
    if (name === "IHDR") {
      width = view.getUint32(at + 8), height = view.getUint32(at + 12);
      channels = {0: 1, 2: 3, 4: 2, 6: 4}[data[9]];
      if (data[8] !== 8 || !channels || data[12] !== 0) throw new Error("expected a PNG of 8 bits a channel without palette, not interlaced");
    } else if (name === "IDAT") {
      parts.push(data);
    }
    at += 12 + size;
  }
  const row = width * channels, raw = inflate(joined(parts), (row + 1) * height), texels = new Uint8Array(row * height);
  for (let y = 0; y < height; ++y) {
    const filter = raw[y * (row + 1)], source = y * (row + 1) + 1, to = y * row;
    for (let i = 0; i < row; ++i) {
      const a = i < channels ? 0 : texels[to + i - channels], b = y === 0 ? 0 : texels[to + i - row];
      const c = i < channels || y === 0 ? 0 : texels[to + i - row - channels];
      let guess = [0, a, b, (a + b) >> 1, 0][filter];
      if (filter === 4) {
        const pa = Math.abs(b - c), pb = Math.abs(a - c), pc = Math.abs(a + b - 2 * c);
        guess = pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
      }
      texels[to + i] = raw[source + i] + guess;
    }
  }
  return {width, height, channels, texels};
}

function crc32(bytes) {
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let k = 0; k < 8; ++k) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
}

// `rgba`: the lowest row first, as readPixels gives them.
function encodePng(width, height, rgba) {
  const rows = new Uint8Array(height * (4 * width + 1));
  for (let y = 0; y < height; ++y) rows.set(rgba.subarray((height - 1 - y) * 4 * width, (height - y) * 4 * width), y * (4 * width + 1) + 1);
  const chunk = (name, data) => {
    const bytes = new Uint8Array(12 + data.length), view = new DataView(bytes.buffer);
    view.setUint32(0, data.length);
    bytes.set(new TextEncoder().encode(name), 4);
    bytes.set(data, 8);
    view.setUint32(8 + data.length, crc32(bytes.subarray(4, 8 + data.length)));
    return bytes;
  };
  const head = new Uint8Array([0, 0, 0, 0, 0, 0, 0, 0, 8, 6, 0, 0, 0]);
  new DataView(head.buffer).setUint32(0, width);
  new DataView(head.buffer).setUint32(4, height);
  const signature = new Uint8Array([137, 80, 78, 71, 13, 10, 26, 10]);
  return joined([signature, chunk("IHDR", head), chunk("IDAT", deflateStored(rows)), chunk("IEND", new Uint8Array())]);
}

const vertexShader = `#version 300 es
precision highp float;
layout(location = 0) in vec4 position;
layout(location = 1) in vec2 uv;
layout(location = 2) in vec4 color;
out vec2 at;
out vec4 shade;
void main() { gl_Position = position; at = uv; shade = color; }`;

const fragmentShader = (expression, helpers = "") => `#version 300 es
precision highp float;
precision highp sampler2D;
uniform sampler2D image, map;
in vec2 at;
in vec4 shade;
out vec4 result;
${helpers}
void main() { result = ${expression}; }`;

const shadings = {vertex_color: "shade", texture: "texture(image, at)", indexed: "texture(image, texture(map, at).xy)"};

function program(gl, fragment) {
  const built = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertexShader], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(built, shader);
  }
  gl.linkProgram(built);
  if (!gl.getProgramParameter(built, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(built));
  gl.useProgram(built);
  gl.uniform1i(gl.getUniformLocation(built, "image"), 0);
  gl.uniform1i(gl.getUniformLocation(built, "map"), 1);
  return built;
}

// Level 0 with v = 0 at its first row; `levels`: images of further mip levels, which only a wrong drawing has.
function makeTexture(gl, image, description, levels = []) {
  const texture = gl.createTexture(), n = image.channels;
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  const srgb = description.color_space === "srgb";
  const inner = srgb ? [0, 0, gl.SRGB8, gl.SRGB8_ALPHA8][n - 1] : [gl.R8, gl.RG8, gl.RGB8, gl.RGBA8][n - 1];
  if (!inner) throw new Error(`no sRGB texture of ${n} channels`);
  [image, ...levels].forEach((level, k) => {
    const row = level.width * n, texels = new Uint8Array(level.texels.length);
    for (let y = 0; y < level.height; ++y) {
      const from = description.first_row === "top" ? y : level.height - 1 - y;
      texels.set(level.texels.subarray(from * row, (from + 1) * row), y * row);
    }
    gl.texImage2D(gl.TEXTURE_2D, k, inner, level.width, level.height, 0, [gl.RED, gl.RG, gl.RGB, gl.RGBA][n - 1], gl.UNSIGNED_BYTE, texels);
  });
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAX_LEVEL, levels.length);
  return texture;
}

function makeSampler(gl, sampler, mipmapped) {
  const made = gl.createSampler(), linear = sampler.filter === "linear";
  const wraps = {clamp: gl.CLAMP_TO_EDGE, repeat: gl.REPEAT, mirrored_repeat: gl.MIRRORED_REPEAT};
  const small = mipmapped ? [gl.NEAREST_MIPMAP_NEAREST, gl.LINEAR_MIPMAP_NEAREST] : [gl.NEAREST, gl.LINEAR];
  gl.samplerParameteri(made, gl.TEXTURE_MAG_FILTER, linear ? gl.LINEAR : gl.NEAREST);
  gl.samplerParameteri(made, gl.TEXTURE_MIN_FILTER, small[linear ? 1 : 0]);
  gl.samplerParameteri(made, gl.TEXTURE_WRAP_S, wraps[sampler.wrap_u]);
  gl.samplerParameteri(made, gl.TEXTURE_WRAP_T, wraps[sampler.wrap_v]);
  return made;
}

// Nothing may cross the viewport, where a device clips and so makes vertices of its own: it is the smallest power of two around frame and guard.
function guardViewport(frame) {
  const guard = frame.guard === undefined ? 2048 : frame.guard, extent = (n) => 2 ** Math.ceil(Math.log2(n + 2 * guard));
  const width = extent(frame.width), height = extent(frame.height);
  return {x: -(width - frame.width) / 2, y: -(height - frame.height) / 2, width, height};
}

// The draws by WebGL2: RGBA, 8 bits, the lowest row first. `images` in the header's order. `wrong` is for who wants wrong pictures:
// {fragment: {shading: [expression, helpers]}, levels: [mip images of each image]}.
function drawScene(gl, scene, images, wrong = {}) {
  const {header, vertices} = scene, {frame, state} = header, v = guardViewport(frame);
  const raster = header.draws.every((draw) => draw.space === "raster");
  if (!raster && header.draws.some((draw) => draw.space === "raster")) throw new Error("one space for all draws, please");
  const data = new Float32Array(10 * vertices.length), step = 2 ** state.subtexel_bits;
  vertices.forEach((p, i) => {
    const ndc = (x, origin, extent) => (x / step - (origin + extent / 2)) / (extent / 2);
    const position = raster ? [ndc(p.x, v.x, v.width) * p.w, ndc(p.y, v.y, v.height) * p.w, (2 * p.z - 1) * p.w, p.w] : [p.x, p.y, p.z, p.w];
    data.set([...position, ...p.uv, ...p.color], 10 * i);
  });

  const target = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, target);
  for (const [point, format] of [[gl.COLOR_ATTACHMENT0, gl.RGBA8], [gl.DEPTH_ATTACHMENT, gl.DEPTH_COMPONENT32F]]) {
    const buffer = gl.createRenderbuffer();
    gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
    gl.renderbufferStorage(gl.RENDERBUFFER, format, frame.width, frame.height);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, point, gl.RENDERBUFFER, buffer);
  }
  if (raster) gl.viewport(v.x, v.y, v.width, v.height);
  else gl.viewport(0, 0, frame.width, frame.height);
  gl.disable(gl.DITHER);
  const clear = ((header.targets || []).find((t) => t.content === "color") || {}).clear || [0, 0, 0, 0];
  gl.clearColor(...clear);
  gl.clearDepth(1);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  const enable = (what, on) => (on ? gl.enable(what) : gl.disable(what));
  enable(gl.DEPTH_TEST, state.depth_test);
  gl.depthFunc(gl.LESS);
  enable(gl.CULL_FACE, state.cull !== "none");
  gl.frontFace(state.cull === "clockwise" ? gl.CCW : gl.CW);

  gl.bindVertexArray(gl.createVertexArray());
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
  [[0, 4, 0], [1, 2, 16], [2, 4, 24]].forEach(([location, size, offset]) => {
    gl.enableVertexAttribArray(location);
    gl.vertexAttribPointer(location, size, gl.FLOAT, false, 40, offset);
  });
  const levels = wrong.levels || [];
  const textures = images.map((image, i) => makeTexture(gl, image, header.images[i], levels[i]));
  header.draws.forEach((draw, d) => {
    const [expression, helpers] = (wrong.fragment || {})[draw.shading] || [shadings[draw.shading]];
    program(gl, fragmentShader(expression, helpers));
    [[draw.texture, draw.sampler], [draw.indexing_map, draw.map_sampler]].forEach(([image, sampler], unit) => {
      if (image === undefined) return;
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, textures[image]);
      gl.bindSampler(unit, makeSampler(gl, sampler, (levels[image] || []).length > 0));
    });
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, scene.indices[d], gl.STATIC_DRAW);
    gl.drawElements(gl.TRIANGLES, scene.indices[d].length, gl.UNSIGNED_INT, 0);
  });
  const rgba = new Uint8Array(4 * frame.width * frame.height);
  gl.readPixels(0, 0, frame.width, frame.height, gl.RGBA, gl.UNSIGNED_BYTE, rgba);
  const error = gl.getError();
  if (error) throw new Error(`WebGL error 0x${error.toString(16)}`);
  textures.forEach((texture) => gl.deleteTexture(texture));
  return rgba;
}

// "ANGLE (Google, Vulkan 1.3.0 (SwiftShader …)), 4 sub-texel bits"
function deviceName(gl) {
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  return `${gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER)}, ${gl.getParameter(gl.SUBPIXEL_BITS)} sub-texel bits`;
}
