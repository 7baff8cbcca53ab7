#include "cli/adapt_psnr.h"

#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/draw/scene.h"
#include "raster/cpu_renderer.h"
#include "validation/metrics/decibel.h"

namespace etalon::cli {

using Json = nlohmann::ordered_json;

namespace {

struct View {
  Image color, id;
};

View drawn(const Mesh& mesh, const std::shared_ptr<const Image>& texture, const Camera& camera, int size) {
  Frame frame{.width = size, .height = size, .guard = 2048, .state = {}, .targets = {}};
  frame.targets = {{TargetContent::color, kRgba8, {0, 0, 0, 1}}, {TargetContent::triangle_id, kR32ui, {}}};
  const Material material{.texture = texture, .sampler = {Filter::linear, Wrap::clamp, Wrap::clamp}};
  raster::CpuRenderer renderer;
  std::vector<Image> images = renderer.render(make_scene(mesh, {material}, camera, frame), frame);
  return {std::move(images[0]), std::move(images[1])};
}

// Squared differences of red, green and blue where both views show the surface.
struct CommonSums {
  std::uint64_t texels = 0, squares = 0;
  void add(const View& a, const View& b) {
    const auto *p = a.color.channels<std::uint8_t>(0, 0), *q = b.color.channels<std::uint8_t>(0, 0);
    const auto *id_a = a.id.channels<std::uint32_t>(0, 0), *id_b = b.id.channels<std::uint32_t>(0, 0);
    for (std::size_t n = 0; n < a.color.texel_count(); ++n) {
      if (id_a[n] == kNoTriangle || id_b[n] == kNoTriangle) continue;
      ++texels;
      for (std::size_t k = 4 * n; k < 4 * n + 3; ++k) squares += static_cast<std::uint64_t>((p[k] - q[k]) * (p[k] - q[k]));
    }
  }
  [[nodiscard]] std::optional<double> db() const { return validation::psnr_db(static_cast<double>(squares), 3 * texels, 255); }
};

// One material for all faces.
Mesh without_materials(Mesh mesh) {
  mesh.face_materials.clear();
  return mesh;
}

}  // namespace

Json level_psnr(const Mesh& full, const Mesh& level, const Image& texture, const Image& adapted, int size, Console& console) {
  constexpr int kViews = 24;
  const Mesh fine = without_materials(full), coarse = without_materials(level);
  const BoundingBox box = bounding_box(fine);
  const auto original = std::make_shared<const Image>(texture), changed = std::make_shared<const Image>(adapted);
  CommonSums with, without;
  for (int n = 0; n < kViews; ++n) {
    const Camera camera = view_of_24(box, n);
    const View truth = drawn(fine, original, camera, size);
    with.add(truth, drawn(coarse, changed, camera, size));
    without.add(truth, drawn(coarse, original, camera, size));
    console.progress("views", n + 1, kViews);
  }
  const auto json = [](const std::optional<double>& db) { return db ? Json(*db) : Json(); };
  return {{"adapted", json(with.db())}, {"unadapted", json(without.db())}, {"views", kViews}, {"size", size}};
}

std::string psnr_line(const Json& psnr) {
  const auto text = [&](const char* name) {
    return psnr[name].is_null() ? std::string("identical") : fmt::format("{:.2f} dB", psnr[name].get<double>());
  };
  return fmt::format("against the full model, {} views of {}²: {} adapted, {} as it is", psnr["views"].get<int>(), psnr["size"].get<int>(),
                     text("adapted"), text("unadapted"));
}

}  // namespace etalon::cli
