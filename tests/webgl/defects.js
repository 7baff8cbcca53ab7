// What goes wrong in pipelines, done to a scene before draws_webgl.js draws it. Each returns what drawScene() takes as `wrong`.
"use strict";

// Filters as a sampler with weights of 1/256 does: every tap and the sum exact, the weights not.
const coarseFilter = `vec4 coarse(vec2 uv) {
  vec2 x = uv * vec2(textureSize(image, 0)) - 0.5, i = floor(x), f = floor((x - i) * WEIGHTS) / WEIGHTS;
  ivec2 n = textureSize(image, 0), a = ivec2(i);
  #define TAP(dx, dy) texelFetch(image, WRAP(a + ivec2(dx, dy), n), 0)
  return mix(mix(TAP(0, 0), TAP(1, 0), f.x), mix(TAP(0, 1), TAP(1, 1), f.x), f.y);
}`;

const wrapOf = {repeat: "((P) - N * (P / N) + N) % N", clamp: "clamp(P, ivec2(0), N - 1)"};

function withWeights(steps) {
  return (scene) => {
    const wrap = wrapOf[scene.header.draws[0].sampler.wrap_u];
    const helpers = `#define WRAP(P, N) (${wrap})\n#define WEIGHTS ${steps}.0\n${coarseFilter}`;
    return {fragment: {texture: ["coarse(at)", helpers]}};
  };
}

const shifted = (du, dv) => (scene, images) => {
  const image = images[scene.header.draws[0].texture];
  for (const vertex of scene.vertices) vertex.uv = [vertex.uv[0] + du / image.width, vertex.uv[1] + dv / image.height];
  return {};
};

const sampler = (change) => (scene) => {
  for (const draw of scene.header.draws) Object.assign(draw.sampler, change);
  return {};
};

function halved(image) {
  const {width, height, channels: n, texels} = image, w = width >> 1, h = height >> 1, small = new Uint8Array(w * h * n);
  for (let y = 0; y < h; ++y)
    for (let x = 0; x < w; ++x)
      for (let c = 0; c < n; ++c) {
        const at = (2 * y * width + 2 * x) * n + c;
        small[(y * w + x) * n + c] = (texels[at] + texels[at + n] + texels[at + width * n] + texels[at + width * n + n] + 2) >> 2;
      }
  return {width: w, height: h, channels: n, texels: small};
}

const pyramid = (image) => (image.width > 1 && image.height > 1 ? [halved(image), ...pyramid(halved(image))] : []);

// Older content of a texture: what it was before somebody painted over it.
function older(image) {
  const {width, height, channels: n} = image, texels = new Uint8Array(image.texels.length);
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x) {
      const from = (((x * height / width) | 0) * width + ((y * width / height) | 0)) * n, to = (y * width + x) * n;
      for (let c = 0; c < n; ++c) texels[to + c] = c === 3 ? image.texels[from + c] : 255 - image.texels[from + c];
    }
  return {...image, texels};
}

const defects = {
  none: () => ({}),
  half_texel: shifted(0.5, 0.5),
  half_texel_u: shifted(-0.5, 0),
  clamp: sampler({wrap_u: "clamp", wrap_v: "clamp"}),
  mirror: sampler({wrap_u: "mirrored_repeat", wrap_v: "mirrored_repeat"}),
  linear: sampler({filter: "linear"}),
  nearest: sampler({filter: "nearest"}),
  weights_8: withWeights(256),
  weights_4: withWeights(16),
  v_flipped: (scene) => {
    for (const vertex of scene.vertices) vertex.uv[1] = 1 - vertex.uv[1];
    return {};
  },
  upside_down: () => ({flip: true}),
  mipmaps: (scene, images) => ({levels: images.map(pyramid)}),
  stale_mip: (scene, images) => ({levels: images.map((image) => pyramid(image).map((level, k) => (k === 1 ? older(level) : level)))}),
  // Mip level 0 is new, the levels below are not: the update forgot generateMipmap.
  stale_mips: (scene, images) => ({levels: images.map((image) => pyramid(older(image)))}),
  stale_texture: (scene, images) => {
    images[0] = older(images[0]);
    return {};
  },
  // An update of one rectangle that did not arrive.
  stale_region: (scene, images) => {
    const image = images[0], old = older(image), {width, height, channels} = image;
    const texels = image.texels.slice();
    for (let y = height >> 2; y < height >> 1; ++y) {
      const from = (y * width + (width >> 2)) * channels, to = (y * width + (3 * width >> 2)) * channels;
      texels.set(old.texels.subarray(from, to), from);
    }
    images[0] = {...image, texels};
    return {};
  },
  geometry: (scene) => {
    for (const vertex of scene.vertices) vertex.x += 1 << (scene.header.state.subtexel_bits - 1);
    return {};
  },
  no_depth_test: (scene) => {
    scene.header.state.depth_test = false;
    return {};
  },
  red_blue: () => ({swap: true}),
};
