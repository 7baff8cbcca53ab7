#include "validation/studies/textured_view.h"

#include <fmt/format.h>

#include <array>

#include "core/base/error.h"
#include "core/draw/scene.h"
#include "validation/metrics/decibel.h"

namespace etalon::validation {

StudyScene textured_scene(const TexturedMesh& what, const Camera& camera, int width, int height, const RasterState& state) {
  StudyScene scene;
  scene.frame = {.width = width, .height = height, .guard = 2048, .state = state, .targets = {}};
  scene.frame.targets = {{TargetContent::color, kRgba8, {0, 0, 0, 1}}, {TargetContent::triangle_id, kR32ui, {}}};
  const Sampler sampler{what.filter, Wrap::clamp, Wrap::clamp};
  const Material material{.texture = what.texture, .sampler = sampler, .indexing_map = what.map, .map_sampler = sampler};
  std::uint32_t materials = 1;
  for (const std::uint32_t m : what.mesh->face_materials) materials = std::max(materials, m + 1);
  scene.list = make_scene(*what.mesh, std::vector<Material>(materials, material), camera, scene.frame);
  return scene;
}

DrawnView draw_textured(Renderer& renderer, const TexturedMesh& what, const Camera& camera, int width, int height) {
  const StudyScene scene = textured_scene(what, camera, width, height, renderer.supported_state({}));
  std::vector<Image> images = renderer.render(scene.list, scene.frame);
  return {std::move(images[0]), std::move(images[1])};
}

void PictureSums::add(const DrawnView& a, const DrawnView& b) {
  ETALON_CHECK(a.color.format() == kRgba8 && b.color.format() == kRgba8 && a.color.texel_count() == b.color.texel_count(),
               "pictures of one size and format");
  const auto *p = a.color.channels<std::uint8_t>(0, 0), *q = b.color.channels<std::uint8_t>(0, 0);
  const auto *id_a = a.id.channels<std::uint32_t>(0, 0), *id_b = b.id.channels<std::uint32_t>(0, 0);
  const auto squared = [](const std::uint8_t* one, const std::uint8_t* other) {
    std::uint32_t square = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const int d = one[k] - other[k];
      square += static_cast<std::uint32_t>(d * d);
    }
    return square;
  };
  const auto width = static_cast<std::size_t>(a.color.width());
  bool common_before = false;
  for (std::size_t n = 0; n < a.color.texel_count(); ++n) {
    const std::uint32_t square = squared(p + 4 * n, q + 4 * n);
    sse += square;
    const bool common = id_a[n] != kNoTriangle && id_b[n] != kNoTriangle;
    if (common) common_sse += square, ++common_texels;
    if (common && common_before && n % width != 0)
      detail_a += squared(p + 4 * n, p + 4 * (n - 1)), detail_b += squared(q + 4 * n, q + 4 * (n - 1));
    common_before = common;
  }
  texels += a.color.texel_count();
}

std::optional<double> PictureSums::whole_db() const { return psnr_db(static_cast<double>(sse), 3 * texels, 255); }
std::optional<double> PictureSums::masked_db() const { return psnr_db(static_cast<double>(common_sse), 3 * common_texels, 255); }

Image averaged_down(const Image& picture, int factor) {
  ETALON_CHECK(picture.format() == kRgb8 && factor > 0 && picture.width() % factor == 0 && picture.height() % factor == 0,
               "a picture that divides");
  Image result(picture.width() / factor, picture.height() / factor, kRgb8);
  for (int y = 0; y < result.height(); ++y)
    for (int x = 0; x < result.width(); ++x) {
      std::array<int, 3> sum{};
      for (int j = 0; j < factor; ++j)
        for (int i = 0; i < factor; ++i)
          for (std::size_t k = 0; k < 3; ++k) sum[k] += picture.channels<std::uint8_t>(x * factor + i, y * factor + j)[k];
      for (std::size_t k = 0; k < 3; ++k)
        result.channels<std::uint8_t>(x, y)[k] = static_cast<std::uint8_t>((2 * sum[k] + factor * factor) / (2 * factor * factor));
    }
  return result;
}

Image on_paper(const DrawnView& view) {
  constexpr std::uint8_t kPaper = 236;
  Image result(view.color.width(), view.color.height(), kRgb8);
  for (int y = 0; y < result.height(); ++y)
    for (int x = 0; x < result.width(); ++x) {
      const bool shown = *view.id.channels<std::uint32_t>(x, y) != kNoTriangle;
      for (std::size_t k = 0; k < 3; ++k)
        result.channels<std::uint8_t>(x, y)[k] = shown ? view.color.channels<std::uint8_t>(x, y)[k] : kPaper;
    }
  return result;
}

}  // namespace etalon::validation
