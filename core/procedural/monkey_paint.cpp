#include "core/procedural/monkey_paint.h"

#include <cmath>

#include "core/procedural/monkey_shape.h"
#include "core/procedural/noise.h"
#include "core/procedural/vertex_light.h"

namespace etalon::procedural {

namespace {

Vec3d rgb(int r, int g, int b) { return {r / 255.0, g / 255.0, b / 255.0}; }

/// Olive crown, dark back, golden beard, pale whiskers; strands that run back and down, in colour only.
Vec3d fur_color(const Vec3d& p, const Vec3d& q) {
  const double patchy = fractal_noise(p * 2.6, 3, 17);
  Vec3d color = mix(rgb(70, 58, 34), rgb(112, 92, 46), smooth_step(-0.6, 0.8, patchy + p.y));
  color = mix(color, rgb(38, 32, 26), smooth_step(0.0, -0.6, p.z + 0.15 * patchy));
  const double beard = smooth_step(-0.42, -0.62, p.y + 0.10 * patchy) * smooth_step(0.05, 0.30, p.z);
  color = mix(color, mix(rgb(236, 160, 44), rgb(252, 206, 104), smooth_step(-0.5, 0.7, patchy)), beard);
  const double whisker = bump(length((q - Vec3d(0.62, -0.22, 0.10)) * Vec3d(1.2, 0.9, 1)), 0.46);
  color = mix(color, rgb(238, 226, 198), smooth_step(0.15, 0.6, whisker + 0.15 * patchy) * (1 - beard));
  const double crest = smooth_step(0.16, 0.03, q.x + 0.03 * fractal_noise(p * 6.0, 2, 3)) * smooth_step(0.45, 0.75, p.y);
  color = mix(color, rgb(44, 32, 24), 0.8 * crest);
  const Vec3d along(p.x * 34, p.y * 9 + 12 * p.z * p.z, p.z * 14);
  const double strand = fractal_noise(along, 3, 91);
  return color * (1 + 0.34 * strand);
}

/// The mandrill's mask: scarlet nose, blue ridges with dark grooves, rosy lids.
Vec3d skin_color(const Vec3d& p, const Vec3d& q) {
  Vec3d color = mix(rgb(66, 52, 50), rgb(112, 84, 76), smooth_step(-0.5, 0.5, fractal_noise(p * 5.0, 3, 5)));
  const double grooved = q.x + 0.25 * (q.y + 0.1);  // stripes run along the muzzle
  const double on_ridge = smooth_step(0.045, 0.075, q.x) * smooth_step(0.36, 0.27, q.x) * smooth_step(-0.34, -0.26, p.y) *
                          smooth_step(0.16, 0.06, p.y) * smooth_step(0.45, 0.6, p.z);
  const double stripe = sin_turns(grooved * 19 + 0.06 * fractal_noise(p * 4.0, 2, 33));
  const Vec3d blue = mix(rgb(40, 84, 190), rgb(150, 196, 244), smooth_step(-0.4, 0.7, stripe));
  color = mix(color, blue, on_ridge);
  const double nose_top = mix(0.055, 0.115, smooth_step(0.2, -0.15, p.y));
  const double on_nose = smooth_step(nose_top + 0.02, nose_top - 0.02, q.x) * smooth_step(0.34, 0.20, p.y) *
                         smooth_step(-0.30, -0.22, p.y) * smooth_step(0.5, 0.6, p.z);
  color = mix(color, mix(rgb(206, 30, 36), rgb(240, 84, 66), smooth_step(-0.3, 0.6, fractal_noise(p * 8.0, 3, 61))), on_nose);
  const double lips = bump(p.y - monkey_mouth(q.x), 0.10) * smooth_step(0.5, 0.7, p.z) * smooth_step(0.36, 0.26, q.x);
  color = mix(color, rgb(190, 92, 88), 0.75 * lips);
  color = mix(color, rgb(56, 16, 22),
              smooth_step(0.020, 0.007, std::fabs(p.y - monkey_mouth(q.x))) * smooth_step(0.56, 0.66, p.z) * smooth_step(0.37, 0.31, q.x));
  color = mix(color, rgb(30, 10, 14), smooth_step(0.046, 0.030, length((q - Vec3d(0.068, -0.185, 1.165)) * Vec3d(1, 1.25, 0.8))));
  const MonkeyEye& eye = monkey_eye();
  const double lid = bump(length(q - eye.center) - eye.radius, 0.07);
  color = mix(color, rgb(214, 150, 140), 0.6 * lid);
  const Cells freckles = cellular_noise(p * 16.0, 7);
  const double pads = smooth_step(-0.24, -0.28, p.y) * smooth_step(-0.44, -0.38, p.y) * smooth_step(0.8, 0.9, p.z);
  return mix(color, rgb(24, 16, 16), 0.8 * pads * smooth_step(0.22, 0.14, freckles.nearest));
}

Vec3d eye_color(const Vec3d& p) {
  const MonkeyEye& eye = monkey_eye();
  const double side = p.x < 0 ? -1 : 1;
  const Vec3d d = normalized(Vec3d(p.x * side, p.y, p.z) - eye.center);
  const Vec3d right = normalized(cross(Vec3d(0, 1, 0), eye.axis)), up = cross(eye.axis, right);
  const double x = dot(d, right), y = dot(d, up), r = dot(d, eye.axis) > 0 ? std::sqrt(x * x + y * y) : 1;
  constexpr double kIris = 0.66, kPupil = 0.30;
  Vec3d iris = mix(rgb(232, 150, 40), rgb(136, 66, 18), smooth_step(kPupil, kIris, r));
  const double inv = 1 / (r + 1e-6);
  iris *= 1 + 0.3 * fractal_noise(Vec3d(x * inv * 7, y * inv * 7, r * 3), 2, 44);
  Vec3d color = mix(iris, rgb(226, 208, 186), smooth_step(kIris - 0.03, kIris + 0.03, r));
  color = mix(color, rgb(50, 24, 12), 0.8 * bump(r - kIris, 0.10));
  color = mix(rgb(12, 8, 10), color, smooth_step(kPupil - 0.03, kPupil + 0.03, r));
  const double glint = smooth_step(0.17, 0.11, length(Vec3d(x * side + 0.20, y - 0.24, 0)));
  return mix(color, rgb(255, 252, 244), glint);
}

}  // namespace

Vec3d monkey_color(const Vec3d& p) {
  const Vec3d q(std::fabs(p.x), p.y, p.z);
  const MonkeyEye& eye = monkey_eye();
  const Vec3d normal = field_normal(monkey_field, p, 4e-3);
  const VertexLightOptions lamp{.to_key = {0.45, 0.75, 0.70}, .size = 1.3, .strength = 0.78};
  const Vec3d light = vertex_light(monkey_field, p, normal, lamp) * 1.18;
  if (length(q - eye.center) < eye.radius + 0.004) return eye_color(p) * (Vec3d(0.35, 0.35, 0.35) + light * 0.65);
  const double bare = monkey_face(p);
  Vec3d color = mix(fur_color(p, q), skin_color(p, q), bare);
  color = mix(color, mix(rgb(168, 104, 92), rgb(222, 160, 142), smooth_step(-0.4, 0.4, fractal_noise(p * 6.0, 2, 9))), monkey_ear_cup(p));
  return color * light;
}

}  // namespace etalon::procedural
