#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "core/io/image_file.h"
#include "core/math/nearest_point.h"
#include "core/mesh/adjacency.h"
#include "core/mesh/weld.h"
#include "validation/studies/soucy_scans.h"
#include "validation/studies/surface_shading.h"
#include "validation/verify/pictures.h"

namespace etalon::validation {
namespace {

// Binary PLY as core/io writes it, without the header: a vertex as three float32, with colours three bytes more; a face as a count and three
// int32, with texture coordinates a count and six float32 more, and the texture's number.
constexpr std::uint64_t kVertexBytes = 12, kColorBytes = 3, kFaceBytes = 13, kCoordinateBytes = 29;

std::uint64_t colored_bytes(const Mesh& mesh) {
  return (kVertexBytes + kColorBytes) * mesh.vertex_count() + kFaceBytes * mesh.face_count();
}
std::uint64_t textured_bytes(const Mesh& mesh) {
  return kVertexBytes * mesh.vertex_count() + (kFaceBytes + kCoordinateBytes) * mesh.face_count();
}

/// Mean sizes of the triangles whose normals differ least, and most, from those of their neighbours: a quarter of all each.
std::array<double, 2> flat_and_bent_size(const Mesh& mesh, const bake::Atlas& atlas) {
  const Adjacency adjacency(mesh);
  const auto normal = [&](FaceId f) {
    const Vec3d n =
        cross_product(difference_of(mesh.position(f, 0), mesh.position(f, 1)), difference_of(mesh.position(f, 0), mesh.position(f, 2)));
    const double length = std::sqrt(dot_product(n, n));
    return length > 0 ? n * (1 / length) : Vec3d(0, 0, 0);
  };
  std::vector<std::pair<double, std::uint32_t>> bends;  // least cosine with a neighbour, face
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    double least = 1;
    for (int c = 0; c < 3; ++c) {
      const HalfEdgeId other = adjacency.opposite(Adjacency::half_edge(FaceId(f), c));
      if (other.valid()) least = std::min(least, dot_product(normal(FaceId(f)), normal(Adjacency::face(other))));
    }
    bends.emplace_back(-least, f);
  }
  std::sort(bends.begin(), bends.end());
  const std::size_t quarter = std::max<std::size_t>(1, bends.size() / 4);
  const auto mean = [&](std::size_t first) {
    double sum = 0;
    for (std::size_t n = first; n < first + quarter; ++n) sum += atlas.tiles[bends[n].second].size;
    return sum / static_cast<double>(quarter);
  };
  return {mean(0), mean(bends.size() - quarter)};
}

/// The model from around, once.
class Views {
 public:
  Views(const SoucyModel& model, const SoucyTools& tools) : name_(model.name), tools_(tools), box_(bounding_box(model.mesh)) {
    for (int n = 0; n < tools.options.view_count; ++n) originals_.push_back(draw_colored(model.mesh, n));
  }
  [[nodiscard]] PictureSums of_colored(const Mesh& mesh) const {
    PictureSums sums;
    for (std::size_t n = 0; n < originals_.size(); ++n) sums.add(originals_[n], draw_colored(mesh, static_cast<int>(n)));
    return sums;
  }
  [[nodiscard]] PictureSums of_textured(const Mesh& mesh, const std::shared_ptr<const Image>& texture) const {
    PictureSums sums;
    const TexturedMesh what{.mesh = &mesh, .texture = texture, .map = nullptr, .filter = Filter::nearest};
    const int px = tools_.options.views_px;
    for (std::size_t n = 0; n < originals_.size(); ++n)
      sums.add(originals_[n], tools_.drawing.draw(name_, [&](const RasterState& state) {
        return textured_scene(what, view_of_24(box_, static_cast<int>(n)), px, px, state);
      }));
    return sums;
  }

 private:
  [[nodiscard]] DrawnView draw_colored(const Mesh& mesh, int view) const {
    const VertexColorView from{view_of_24(box_, view), tools_.options.views_px, tools_.options.views_px};
    return tools_.drawing.draw(name_, [&](const RasterState& state) { return vertex_color_scene(mesh, from, state); });
  }
  std::string name_;
  const SoucyTools& tools_;
  BoundingBox box_;
  std::vector<DrawnView> originals_;
};

/// Three quarters from the front, above; and from behind, below.
std::array<Camera, 2> viewpoints(const BoundingBox& box) {
  const Camera front = named_view("fit", box, 1, 1);
  Camera below = front;
  const Vec3d away = front.eye - front.target;
  const double distance = std::sqrt(dot_product(away, away));
  constexpr double kDirection[] = {0.8, -0.72, -0.6};
  const double length = std::sqrt(0.8 * 0.8 + 0.72 * 0.72 + 0.6 * 0.6);
  for (int k = 0; k < 3; ++k) below.eye[k] = below.target[k] + kDirection[k] * distance / length;
  return {front, below};
}

/// Above and left of the viewer, in front of the model; behind it where an open surface shows its back.
Vec3d lamp_of(const Mesh& mesh, const Camera& camera) {
  const auto unit = [](const Vec3d& a) { return a * (1 / std::sqrt(dot_product(a, a))); };
  const Vec3d back = unit(camera.eye - camera.target), right = unit(cross_product(camera.up, back)), up = cross_product(back, right);
  double towards = 0, all = 0;  // twice the area seen from its front less that from its back; twice the area
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const Vec3d area = cross_product(difference_of(mesh.position(FaceId(f), 0), mesh.position(FaceId(f), 1)),
                                     difference_of(mesh.position(FaceId(f), 0), mesh.position(FaceId(f), 2)));
    towards += dot_product(area, back), all += std::sqrt(dot_product(area, area));
  }
  const Vec3d lamp = back + up * 0.6 - right * 0.5;
  return towards < -0.1 * all ? lamp * -1.0 : lamp;
}

/// Figure 11: drawn at twice the size, cut to what is shown, and averaged.
class Plate {
 public:
  Plate(const SoucyModel& model, const bake::BakeResult& baked, const SoucyTools& tools) : model_(model), baked_(baked), tools_(tools) {}

  [[nodiscard]] std::array<Image, 6> draw() const {
    const auto [front, below] = viewpoints(bounding_box(model_.mesh));
    const Mesh& small = baked_.simplified.mesh;
    const auto texture = std::make_shared<const Image>(baked_.texture);
    const TexturedMesh textured{.mesh = &baked_.mesh, .texture = texture, .map = nullptr, .filter = Filter::nearest};
    const auto original = [&](const Camera& camera) { return colored(model_.mesh, camera); };
    const auto compressed = [&](const Camera& camera) {
      return drawn([&](const RasterState& state) { return textured_scene(textured, camera, px(), px(), state); });
    };
    const DrawnView c = original(front), e = original(below);
    const ShownSquare at_front = shown_square(c), at_below = shown_square(e);
    return {finished(colored(flat_shaded(model_.mesh, lamp(front)), front), at_front),
            finished(colored(flat_shaded(small, lamp(front)), front), at_front),
            lit(c, model_.mesh, front, at_front),
            lit(compressed(front), small, front, at_front),
            lit(e, model_.mesh, below, at_below),
            lit(compressed(below), small, below, at_below)};
  }

 private:
  [[nodiscard]] int px() const { return 2 * tools_.options.picture_px; }
  [[nodiscard]] Vec3d lamp(const Camera& camera) const { return lamp_of(model_.mesh, camera); }
  [[nodiscard]] DrawnView drawn(const std::function<StudyScene(const RasterState&)>& scene) const {
    return tools_.drawing.draw(model_.name + ", figure 11", scene);
  }
  [[nodiscard]] DrawnView colored(const Mesh& mesh, const Camera& camera) const {
    return drawn([&](const RasterState& state) { return vertex_color_scene(mesh, {camera, px(), px()}, state); });
  }
  [[nodiscard]] static Image finished(const DrawnView& view, const ShownSquare& shown) {
    return averaged_down(crop(on_paper(view), shown.x, shown.y, (shown.side + 1) / 2 * 2), 2);
  }
  // Smooth shading: light interpolated over the triangles, times the picture without it.
  [[nodiscard]] Image lit(DrawnView unlit, const Mesh& mesh, const Camera& camera, const ShownSquare& shown) const {
    const DrawnView light = colored(smooth_shaded(mesh, lamp(camera)), camera);
    const Image product = multiplied(picture_of(unlit.color), picture_of(light.color));
    for (int y = 0; y < product.height(); ++y)
      for (int x = 0; x < product.width(); ++x)
        std::copy_n(product.channels<std::uint8_t>(x, y), 3, unlit.color.channels<std::uint8_t>(x, y));
    return finished(unlit, shown);
  }
  const SoucyModel& model_;
  const bake::BakeResult& baked_;
  const SoucyTools& tools_;
};

SoucyModelMap measure(const Mesh& scan, const bake::BakeResult& baked, const Views& views) {
  SoucyModelMap map{.map_size = baked.atlas.width,
                    .texels = baked.texels,
                    .smallest = baked.atlas.tiles.front().size,
                    .iterations = baked.iterations,
                    .seam_residual = baked.seam_residual,
                    .wrong_means = wrong_mean_count(scan, baked)};
  for (const bake::Tile& tile : baked.atlas.tiles)
    map.smallest = std::min(map.smallest, tile.size), map.largest = std::max(map.largest, tile.size);
  const auto sizes = flat_and_bent_size(baked.simplified.mesh, baked.atlas);
  map.flat_size = sizes[0], map.bent_size = sizes[1];
  map.sums = views.of_textured(baked.mesh, std::make_shared<const Image>(baked.texture));
  map.png_bytes = io::encode_png(baked.texture, "map").size();
  map.bytes = textured_bytes(baked.mesh) + map.png_bytes;
  // A closed surface has half as many vertices as faces.
  map.equal_faces = static_cast<std::size_t>(2 * map.bytes / (kVertexBytes + kColorBytes + 2 * kFaceBytes));
  if (map.equal_faces < scan.face_count())
    map.equal_sums = views.of_colored(simplify::simplify_mesh(scan, {.target_faces = map.equal_faces}).mesh);
  return map;
}

}  // namespace

int model_steps(const SoucyModel&, const SoucyStudyOptions& options) { return 1 + static_cast<int>(options.model_maps.size()); }

SoucyModelResult study_model(const SoucyModel& model, const SoucyTools& tools) {
  SoucyModelResult result;
  result.name = model.name;
  for (const VerifyInput& input : model.inputs)
    if (result.attribution.empty()) result.attribution = input.attribution;
  Mesh scan = model.mesh;
  scan.has_uv = false;
  scan.face_materials.clear();
  scan = welded_by_position(scan);
  result.vertices = scan.vertex_count(), result.faces = scan.face_count(), result.bytes = colored_bytes(scan);
  result.diagonal = bounding_box(scan).diagonal();
  tools.step(fmt::format("{}: {} views of the model", model.name, tools.options.view_count));
  const Views views(model, tools);
  for (const int size : tools.options.model_maps) {
    tools.step(fmt::format("{}: {} faces, {}²", model.name, model.target_faces, size));
    const bake::BakeResult baked = bake::bake_scan(scan, {.target_faces = model.target_faces, .width = size, .height = size});
    if (result.maps.empty()) {
      const Mesh& small = baked.simplified.mesh;
      result.baked_vertices = small.vertex_count(), result.baked_faces = small.face_count(), result.plain_bytes = colored_bytes(small);
      result.distance_max = *baked.simplified.distance_max;
      result.plain_sums = views.of_colored(small);
      if (model.pictured) result.figure11 = Plate(model, baked, tools).draw(), result.atlas = baked.texture;
    }
    result.maps.push_back(measure(scan, baked, views));
  }
  return result;
}

}  // namespace etalon::validation
