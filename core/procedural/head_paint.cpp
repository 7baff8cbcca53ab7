#include "core/procedural/head_paint.h"

#include <cmath>

#include "core/procedural/head_shape.h"
#include "core/procedural/noise.h"

namespace etalon::procedural {

namespace {

const Vec3d kKeyLight = normalized(Vec3d(0.45, 0.75, 0.70));
const Vec3d kRimLight = normalized(Vec3d(-0.70, 0.35, -0.60));

Vec3d rgb(int r, int g, int b) { return {r / 255.0, g / 255.0, b / 255.0}; }

struct Skin {
  Vec3d color;
  Vec3d slope;  ///< gradient of the relief, for shading
  double gloss;
};

/// Scales of about `size`: domes that meet in dark grooves.
struct Scales {
  double dome;  ///< 0 in the groove, 1 on the flat top
  double tint;  ///< −½..½, one value per scale
  Vec3d slope;  ///< gradient of the dome
};
Scales scales_at(const Vec3d& p, double size, std::uint64_t seed) {
  constexpr double kGroove = 0.35;
  const Cells cells = cellular_noise(p * (1 / size), seed);
  const double t = clamp01((cells.second - cells.nearest) / kGroove);
  return {t * t * (3 - 2 * t), static_cast<double>(cells.identity >> 44) * 0x1p-20 - 0.5,
          cells.gradient * (6 * t * (1 - t) / (kGroove * size))};
}

Skin skin_at(const Vec3d& p) {
  const Vec3d q(std::fabs(p.x), p.y, p.z);
  const Vec3d warp(0.10 * fractal_noise(p * 3.1, 3, 11), 0.10 * fractal_noise(p * 3.1, 3, 23), 0.10 * fractal_noise(p * 3.1, 3, 37));
  const Vec3d w = p + warp;

  // Counter-shading: dark teal back, jade sides, cream throat.
  const double throat_line = -0.16 - 0.10 * smooth_step(0.2, 1.0, p.z) + 0.9 * smooth_step(0.0, -0.9, p.z) * -1.0;
  const double belly = smooth_step(0.16, -0.12, w.y - throat_line) * smooth_step(-0.55, 0.1, p.z + 0.45 * (p.y + 0.3));
  Vec3d color = mix(rgb(34, 128, 118), rgb(66, 168, 120), smooth_step(-0.6, 0.5, w.y + 0.25 * fractal_noise(p * 2.3, 2, 5)));
  color = mix(color, rgb(22, 92, 104), smooth_step(0.35, 0.75, w.y) * 0.7);
  color = mix(color, rgb(240, 220, 168), belly);

  // Tiger bands on neck and back of the skull.
  const double band = sin_turns((p.y * 1.55 - p.z * 0.55 + warp.x * 1.6 + warp.y * 1.4) * 1.25);
  const double bands = smooth_step(0.15, 0.55, band) * smooth_step(0.12, -0.35, p.z) * (1 - 0.75 * belly);
  color = mix(color, rgb(12, 58, 78), 0.75 * bands);

  // Crest: from coral at the root to gold at the edge, with rays.
  const CrestPlace crest = crest_place(p);
  const double on_crest = smooth_step(0.02, 0.22, crest.rise + 0.05 * fractal_noise(p * 6.0, 2, 71));
  if (on_crest > 0) {
    Vec3d sail = mix(rgb(214, 62, 66), rgb(252, 176, 64), smooth_step(0.15, 0.95, crest.rise));
    const double ray = cos_turns(crest.phase);
    sail =
        mix(sail, rgb(120, 22, 58), 0.8 * smooth_step(0.25, 0.85, -ray + 0.25 * fractal_noise(p * 5.0, 2, 91)) * (1 - 0.55 * crest.rise));
    sail = mix(sail, rgb(255, 236, 170), smooth_step(0.82, 0.97, crest.rise) * 0.8);
    color = mix(color, sail, on_crest);
  }

  // Bill: warm horn; mouth line; spots on the cheek.
  const double bill = smooth_step(0.92, 1.12, p.z + 0.25 * warp.y + 0.12 * q.x);
  color = mix(color, mix(rgb(232, 168, 84), rgb(250, 206, 120), smooth_step(-0.25, 0.15, p.y)), bill * 0.92);
  const Cells spots = cellular_noise(w * 5.2, 401);
  const double spot = smooth_step(0.34, 0.26, spots.nearest) * smooth_step(0.95, 0.7, p.z) * smooth_step(-0.25, 0.05, p.z) *
                      smooth_step(-0.28, -0.02, w.y) * (1 - on_crest) * (1 - bands);
  color = mix(color, rgb(250, 214, 96), 0.75 * spot);

  // Fine scales on the face, coarse ones on neck and nape, hardly any on the bill.
  const double scaly = (1 - 0.85 * bill) * (1 - 0.6 * on_crest), coarse_share = smooth_step(0.15, -0.35, p.z) * (1 - on_crest);
  Scales fine{1, 0, {0, 0, 0}}, coarse{1, 0, {0, 0, 0}};
  if (coarse_share < 1) fine = scales_at(p, 0.045, 777);
  if (coarse_share > 0) coarse = scales_at(p + warp * 0.25, 0.085, 888);
  color *= 1 + scaly * (0.16 * mix(fine.tint, coarse.tint, coarse_share) + 0.05 * fractal_noise(p * 9.0, 2, 61));
  color *= 1 - scaly * mix(0.22 * (1 - fine.dome), 0.26 * (1 - coarse.dome), coarse_share);

  const double mouth = std::fabs(p.y - mouth_height(p.z));
  const double in_mouth = smooth_step(0.026, 0.008, mouth) * smooth_step(0.24, 0.34, p.z);
  color = mix(color, rgb(70, 20, 30), 0.9 * in_mouth);
  const double blush = bump(length(q - Vec3d(0.44, -0.02, 0.42)), 0.26);
  color = mix(color, rgb(236, 120, 96), 0.45 * blush);
  const double nostril = smooth_step(0.062, 0.035, length((q - Vec3d(0.17, 0.135, 1.33)) * Vec3d(1, 1, 0.7)));
  color = mix(color, rgb(52, 22, 24), nostril);

  return {color, (fine.slope * (0.0035 * (1 - coarse_share)) + coarse.slope * (0.006 * coarse_share)) * scaly, 0.25 + 0.35 * bill};
}

/// The eye looks along its axis: amber iris with fibres, round pupil, dark limbus, two fixed highlights.
Vec3d eye_color(const Vec3d& p, double& emission) {
  const HeadEye& eye = head_eye();
  const double side = p.x < 0 ? -1 : 1;
  const Vec3d d = normalized(Vec3d(p.x * side, p.y, p.z) - eye.center);
  const Vec3d right = normalized(cross(Vec3d(0, 1, 0), eye.axis)), up = cross(eye.axis, right);
  const double x = dot(d, right), y = dot(d, up), r = std::sqrt(x * x + y * y);
  const bool front = dot(d, eye.axis) > 0;
  const double radius = front ? r : 1;
  constexpr double kIris = 0.76, kPupil = 0.42;

  Vec3d color = mix(rgb(250, 244, 228), rgb(226, 190, 160), smooth_step(kIris, 1.0, radius));
  const double inv = 1 / (radius + 1e-6);
  const Vec3d around(x * inv * 5, y * inv * 5, radius * 2.2);
  const double fibre = fractal_noise(around * 2.0, 3, 1234);
  Vec3d iris = mix(rgb(255, 196, 60), rgb(206, 92, 20), smooth_step(0.32, kIris, radius));
  iris = mix(iris, rgb(150, 52, 14), 0.55 * smooth_step(0.0, 0.8, fibre));
  iris = mix(iris, rgb(255, 236, 150), 0.5 * smooth_step(0.1, 0.9, -fibre) * smooth_step(kIris, kPupil, radius));
  iris *= 0.80 + 0.35 * smooth_step(0.5, -0.6, y);  // light gathers in the lower half
  color = mix(iris, color, smooth_step(kIris - 0.02, kIris + 0.02, radius));
  color = mix(color, rgb(46, 18, 10), 0.85 * bump(radius - kIris, 0.09));
  color = mix(rgb(10, 6, 10), color, smooth_step(kPupil - 0.02, kPupil + 0.03, radius));
  const double sx = side > 0 ? x : -x;  // both highlights come from the same lamp
  const double large = smooth_step(0.17, 0.12, length(Vec3d(sx - (side > 0 ? -0.16 : 0.30), y - 0.28, 0)));
  const double small = smooth_step(0.08, 0.045, length(Vec3d(sx - (side > 0 ? 0.22 : -0.12), y + 0.26, 0)));
  emission = std::fmax(large, 0.65 * small);
  return color;
}

}  // namespace

HeadLight head_light_at(const Vec3d& p) {
  const Vec3d normal = field_normal(head_field, p, 2e-3);
  return {sky_visibility(head_field, p, normal, 40, 1.3), light_visibility(head_field, p, normal, kKeyLight, 0.22, 2.5)};
}

Vec3d head_color(const Vec3d& near_surface, const HeadLight& light) {
  const HeadEye& eye = head_eye();
  const auto distance_to_eye = [&](const Vec3d& q) { return length(Vec3d(std::fabs(q.x), q.y, q.z) - eye.center); };
  // Between vertices a point lies off the surface by its curvature; that shows only at the rims of eye, mouth and nostrils.
  const bool delicate =
      distance_to_eye(near_surface) < 1.6 * eye.radius || (near_surface.z > 0.2 && near_surface.y > -0.4 && near_surface.y < 0.3);
  const Vec3d p = delicate ? projected(head_field, near_surface, 2) : near_surface;
  const double from_eye = distance_to_eye(p);
  const double in_eye = smooth_step(eye.radius + 0.011, eye.radius + 0.004, from_eye);

  Vec3d normal = field_normal(head_field, p, 1.5e-3);
  Vec3d color;
  double emission = 0, gloss = 0.25;
  const Skin skin = skin_at(p);
  color = skin.color;
  gloss = skin.gloss;
  // A pale ring around the eye, and a dark rim like kohl.
  color = mix(color, rgb(148, 206, 150), 0.6 * bump(from_eye - eye.radius - 0.055, 0.055));
  color = mix(color, rgb(24, 30, 44), 0.85 * smooth_step(eye.radius + 0.034, eye.radius + 0.014, from_eye));
  if (in_eye > 0) {
    color = mix(color, eye_color(p, emission), in_eye);
    emission *= in_eye;
  }
  if (in_eye < 1) {
    normal = normalized(normal - (skin.slope - normal * dot(skin.slope, normal)) * (1 - in_eye));
  }

  const double key = std::fmax(0, dot(normal, kKeyLight)) * light.key;
  const double wrap = clamp01(0.5 + 0.5 * dot(normal, kKeyLight));
  const double rim = std::fmax(0, dot(normal, kRimLight));
  const double up = 0.5 + 0.5 * normal.y;
  const Vec3d sky = mix(rgb(168, 136, 120), rgb(180, 206, 236), up) * (light.sky * 0.66);
  const Vec3d total =
      sky + Vec3d(1.0, 0.93, 0.82) * (0.62 * key + 0.12 * wrap * light.sky) + Vec3d(0.45, 0.55, 0.85) * (0.30 * rim * light.sky);
  Vec3d lit = color * total;
  // A soft sheen toward the mean viewer in front of the head: a baked texture has no viewer of its own.
  const Vec3d half = normalized(kKeyLight + normalized(Vec3d(0.35, 0.1, 1)));
  const double s = std::fmax(0, dot(normal, half)), s2 = s * s, s4 = s2 * s2, s8 = s4 * s4, s16 = s8 * s8;
  lit += Vec3d(1, 0.97, 0.9) * (gloss * 0.35 * s16 * light.key);
  lit = mix(lit, Vec3d(1, 1, 1), emission);
  // Filmic shoulder: bright places keep their hue.
  for (int k = 0; k < 3; ++k) lit[k] = lit[k] * (1.12 - 0.12 * clamp01(lit[k]));
  return lit;
}

}  // namespace etalon::procedural
