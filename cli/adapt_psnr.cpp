#include "cli/adapt_psnr.h"

#include <fmt/format.h>

#include <memory>
#include <optional>

#include "raster/cpu_renderer.h"
#include "validation/studies/textured_view.h"

namespace etalon::cli {

using Json = nlohmann::ordered_json;

Json level_psnr(const Mesh& full, const Mesh& level, const Image& texture, const Image& adapted, int size, Console& console) {
  constexpr int kViews = 24;
  const BoundingBox box = bounding_box(full);
  const auto original = std::make_shared<const Image>(texture), changed = std::make_shared<const Image>(adapted);
  raster::CpuRenderer renderer;
  validation::PictureSums with, without;
  for (int n = 0; n < kViews; ++n) {
    const Camera camera = view_of_24(box, n);
    const auto drawn = [&](const Mesh& mesh, const std::shared_ptr<const Image>& what) {
      return validation::draw_textured(renderer, {.mesh = &mesh, .texture = what, .map = nullptr}, camera, size, size);
    };
    const validation::DrawnView truth = drawn(full, original);
    with.add(truth, drawn(level, changed));
    without.add(truth, drawn(level, original));
    console.progress("views", n + 1, kViews);
  }
  const auto json = [](const std::optional<double>& db) { return db ? Json(*db) : Json(); };
  return {{"adapted", json(with.masked_db())}, {"unadapted", json(without.masked_db())}, {"views", kViews}, {"size", size}};
}

std::string psnr_line(const Json& psnr) {
  const auto text = [&](const char* name) {
    return psnr[name].is_null() ? std::string("identical") : fmt::format("{:.2f} dB", psnr[name].get<double>());
  };
  return fmt::format("against the full model, {} views of {}²: {} adapted, {} as it is", psnr["views"].get<int>(), psnr["size"].get<int>(),
                     text("adapted"), text("unadapted"));
}

}  // namespace etalon::cli
