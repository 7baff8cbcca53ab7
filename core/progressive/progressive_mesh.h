// A mesh at every level of detail: a coarse base and the vertex splits that lead back to the original [Hoppe 1996].
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/simplify/simplify.h"

namespace etalon::progressive {

/// Invalid id.
inline constexpr std::uint32_t kNone = 0xFFFFFFFFu;

/// The inverse of one collapse u→v. Ids count appearances: vertices, wedges and faces are numbered as the base and then each split
/// brings them, so at every level those that exist are the first so many.
struct VertexSplit {
  std::uint32_t parent = kNone;                   ///< v; the split brings one vertex, u, and one or two faces on the edge between them
  std::uint32_t first_wedge = 0, first_face = 0;  ///< what it brings starts here and ends where the next split's starts
  std::array<std::uint32_t, 2> wedge_of_parent{kNone, kNone};  ///< of v, left and right of u's curve; kNone on a side without corners
  std::array<std::uint32_t, 2> wedge{kNone, kNone};            ///< of u likewise
  /// Corners that go from v to u: [first_corner, right_corner) on the left side, [right_corner, end_corner) on the right one.
  std::uint32_t first_corner = 0, right_corner = 0, end_corner = 0;
  std::uint32_t move = kNone;  ///< which of the moves takes v back; kNone where the collapse was a half-edge one
};

/// What the parent of a split is before a full-edge collapse moved it, so again after the split.
struct ParentMove {
  Vec3f position{0, 0, 0};
  Vec4f color{0, 0, 0, 1};                           ///< where the mesh has colours
  std::array<std::uint32_t, 2> wedge{kNone, kNone};  ///< wedges of the parent that exist before the split and move, each once
  std::array<Vec2f, 2> uv{};                         ///< theirs; (0, 0) for none
  friend bool operator==(const ParentMove&, const ParentMove&) = default;
};

/// Everything a progressive mesh consists of, coarse to fine; what a file holds.
struct ProgressiveData {
  bool has_uv = false, has_colors = false, has_materials = false;
  std::uint32_t base_vertices = 0, base_wedges = 0, base_faces = 0;
  std::vector<Vec3f> positions;                                ///< #V of all levels, by appearance, and as they appear: moves change them
  std::vector<Vec4f> colors;                                   ///< #V or empty
  std::vector<Wedge> wedges;                                   ///< #W, naming vertices by appearance
  std::vector<std::array<std::uint32_t, 3>> faces;             ///< #F: its wedges when it appears
  std::vector<std::uint32_t> materials;                        ///< #F or empty
  std::vector<std::string> material_names;                     ///< empty, or one for each material that faces name
  std::vector<std::uint32_t> vertex_ids, wedge_ids, face_ids;  ///< in the original mesh: their order is the canonical one
  std::vector<VertexSplit> splits;
  std::vector<std::uint32_t> corners;  ///< 4·face + corner, as the splits name them
  std::vector<ParentMove> moves;       ///< in the order of the splits that name them; none with half-edge collapses

  friend bool operator==(const ProgressiveData&, const ProgressiveData&) = default;
};
[[nodiscard]] bool operator==(const VertexSplit& a, const VertexSplit& b);

/// A progressive mesh at one of its levels. Level k is the base with the first k splits done; both directions cost the faces that change.
class ProgressiveMesh {
 public:
  /// Checks everything once, by going down from the base to the finest level. InputError "split N: what, expected, got" for data that is not
  /// one: references to what is not there yet, corners that are not the parent's, ids used twice, faces without three vertices, vertices and
  /// wedges of no face, materials without a name among names, names with control characters, numbers that are not finite. So what passes has
  /// no violation() at any level. Starts at the base.
  explicit ProgressiveMesh(ProgressiveData data);

  [[nodiscard]] const ProgressiveData& data() const { return data_; }
  [[nodiscard]] std::size_t split_count() const { return data_.splits.size(); }
  [[nodiscard]] std::size_t level() const { return level_; }
  [[nodiscard]] std::size_t face_count() const { return face_count_at(level_); }
  [[nodiscard]] std::size_t face_count_at(std::size_t level) const;
  [[nodiscard]] std::size_t vertex_count() const { return data_.base_vertices + level_; }

  /// The wedges of face f (by appearance; f < face_count()) at the current level.
  [[nodiscard]] const std::array<std::uint32_t, 3>& face_wedges(std::size_t f) const { return faces_[f]; }

  /// Of vertices and wedges (by appearance) that exist at the current level, as they are there.
  [[nodiscard]] const Vec3f& position(std::size_t v) const { return moving_ ? positions_[v] : data_.positions[v]; }
  [[nodiscard]] const Vec4f& color(std::size_t v) const { return moving_ ? colors_[v] : data_.colors[v]; }
  [[nodiscard]] const Vec2f& uv(std::size_t w) const { return moving_ ? uvs_[w] : data_.wedges[w].uv; }

  /// What a split that moves its parent finds at level `split`: place, colour and wedges of the merged vertex.
  [[nodiscard]] const ParentMove& merged_parent(std::size_t split) const { return coarse_[data_.splits[split].move]; }

  void go_to(std::size_t level);
  /// The finest level of at most `faces` faces; the base where there is none.
  void go_to_faces(std::size_t faces);

  /// The current level in canonical order (vertices, wedges and faces as in the original): byte for byte what simplify_mesh() gives with equal
  /// options for this face count.
  [[nodiscard]] Mesh mesh() const;

  /// Whether the current level is a consistent mesh: corners name wedges that exist, every wedge and vertex is used, faces have three
  /// vertices. Empty, or the first violation; O(faces), for tests.
  [[nodiscard]] std::string violation() const;

 private:
  void refine();
  void coarsen();
  [[nodiscard]] std::size_t wedge_count_at(std::size_t level) const;
  void check_base() const;
  void check_materials() const;
  void check_split(std::size_t split) const;
  void check_move(std::size_t split) const;
  [[nodiscard]] ParentMove moved_state(const VertexSplit& split) const;
  void set_moved(const VertexSplit& split, const ParentMove& state);
  [[nodiscard]] std::vector<std::uint32_t> uses_in_base() const;
  void check_uses(std::size_t split, std::vector<std::uint32_t>& wedge_uses) const;

  ProgressiveData data_;
  std::vector<std::array<std::uint32_t, 3>> faces_;                     // current wedges
  std::vector<std::uint32_t> vertex_order_, wedge_order_, face_order_;  // by original id
  std::size_t level_ = 0;
  bool moving_ = false;  // whether there are moves; then the next three are the mesh's own
  std::vector<Vec3f> positions_;
  std::vector<Vec4f> colors_;
  std::vector<Vec2f> uvs_;
  std::vector<ParentMove> coarse_;  // of each move that has been done: what it found
};

struct ProgressiveResult {
  ProgressiveData data;
  simplify::SimplifyResult simplified;  ///< of the base
};

/// Collapses as simplify_mesh() does and keeps the way back. The mesh must be welded (welded_by_position: InputError where one corner
/// of a chart has two wedges of equal uv). The hooks of `options` stay the caller's.
[[nodiscard]] ProgressiveResult make_progressive(const Mesh& mesh, const simplify::SimplifyOptions& options);

}  // namespace etalon::progressive
