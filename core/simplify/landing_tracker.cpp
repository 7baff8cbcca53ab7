#include "core/simplify/landing_tracker.h"

#include <limits>

#include "core/base/error.h"

namespace etalon::simplify {

namespace {

/// Weights of the point at parameter t of the side from corner k to the next one.
Vec3d on_side(std::uint32_t k, double t) {
  Vec3d weights{0, 0, 0};
  weights[static_cast<int>(k)] = 1 - t;
  weights[static_cast<int>((k + 1) % 3)] = t;
  return weights;
}

}  // namespace

LandingTracker::LandingTracker(const CollapseMesh& mesh)
    : mesh_(mesh),
      landings_(mesh.source().vertex_count()),
      head_(mesh.face_capacity(), kNone),
      next_(mesh.source().vertex_count(), kNone),
      curve_corner_(mesh.source().vertex_count(), 0) {}

void LandingTracker::before(std::uint32_t u, const CollapseMesh::Edge& edge) {
  target_ = edge.left != kNone ? mesh_.end(edge.left) : mesh_.start(edge.right);
  moving_.clear();
  for (auto& faces : faces_) faces.clear();
  take_faces(u, edge);

  Moving self{u, edge.left != kNone ? 0 : 1};
  if (mesh_.kind(u) == VertexKind::curve) {
    // The chain v-u-w becomes the edge v-w.
    mesh_.for_each_neighbor(u, [&](std::uint32_t n, std::uint32_t h) {
      if (mesh_.on_curve(h) && n != target_) self.curve_b = n;
    });
    self.curve_a = target_;
    for (Moving& point : moving_)
      if (point.curve_a == u || point.curve_b == u) {
        point.curve_a = self.curve_a;
        point.curve_b = self.curve_b;
      }
  }
  moving_.push_back(self);
}

void LandingTracker::take_faces(std::uint32_t u, const CollapseMesh::Edge& edge) {
  int side = edge.left != kNone ? 0 : 1;
  const std::uint32_t first = edge.left != kNone ? edge.left : mesh_.first_out(u);
  std::uint32_t h = first;
  do {
    const std::uint32_t back = CollapseMesh::previous(h);
    take_points(h >> 2, side);
    if (h != edge.left && back != edge.right) faces_[static_cast<std::size_t>(side)].push_back(h >> 2);
    if (mesh_.on_curve(back)) side = 1;
    h = mesh_.opposite(back);
  } while (h != kNone && h != first);
  // A side of one face, which goes: what lies behind its third edge, which is on no curve, takes its place.
  if (edge.left != kNone && faces_[0].empty()) faces_[0].push_back(mesh_.opposite(CollapseMesh::next(edge.left)) >> 2);
  if (edge.right != kNone && faces_[1].empty() && mesh_.kind(u) == VertexKind::curve)
    faces_[1].push_back(mesh_.opposite(CollapseMesh::previous(edge.right)) >> 2);
}

void LandingTracker::take_points(std::uint32_t face, int side) {
  for (std::uint32_t p = head_[face]; p != kNone; p = next_[p]) {
    Moving point{p, side};
    if (landings_[p].on_curve) {
      point.curve_a = mesh_.start(4 * face + curve_corner_[p]);
      point.curve_b = mesh_.end(4 * face + curve_corner_[p]);
    }
    moving_.push_back(point);
  }
  head_[face] = kNone;
}

void LandingTracker::after() {
  for (const Moving& point : moving_) {
    if (point.curve_a != kNone)
      land_on_edge(point);
    else
      land(point);
  }
}

void LandingTracker::put(std::uint32_t vertex, const Landing& landing) {
  landings_[vertex] = landing;
  next_[vertex] = head_[landing.face.index];
  head_[landing.face.index] = vertex;
}

void LandingTracker::land(const Moving& point) {
  const Vec3d p = place(point.vertex);
  Landing best;
  double distance2 = std::numeric_limits<double>::infinity();
  for (const std::uint32_t f : faces_[static_cast<std::size_t>(point.side)]) {
    const NearestOnTriangle found =
        nearest_on_triangle(p, place(mesh_.start(4 * f)), place(mesh_.start(4 * f + 1)), place(mesh_.start(4 * f + 2)));
    if (found.distance2 > distance2 || (found.distance2 == distance2 && f > best.face.index)) continue;
    best = {FaceId(f), found.weights, false};
    distance2 = found.distance2;
  }
  put(point.vertex, best);
}

void LandingTracker::land_on_edge(const Moving& point) {
  // Every edge of the curve that changed, or lost its face, now has a face at v or is a side of a face that stays.
  Landing best{.face = {}, .weights = {0, 0, 0}, .on_curve = true};
  const auto consider = [&](std::uint32_t f) {
    if (best.face.valid() && f >= best.face.index) return;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh_.start(4 * f + k), b = mesh_.end(4 * f + k);
      if (!(a == point.curve_a && b == point.curve_b) && !(a == point.curve_b && b == point.curve_a)) continue;
      const double t = nearest_on_segment(place(point.vertex), place(a), place(b));
      best.face = FaceId(f);
      best.weights = on_side(k, t);
      curve_corner_[point.vertex] = static_cast<std::uint8_t>(k);
    }
  };
  const std::uint32_t first = mesh_.first_out(target_);
  std::uint32_t h = first;
  do {
    consider(h >> 2);
    h = mesh_.rotate(h);
  } while (h != kNone && h != first);
  ETALON_CHECK(best.face.valid(), "a vertex on a curve has lost its edge");
  put(point.vertex, best);
}

std::vector<Landing> LandingTracker::landings() const {
  std::vector<Landing> result = landings_;
  // On a curve with a face on both sides: the lower one.
  for (std::uint32_t v = 0; v < result.size(); ++v) {
    if (!result[v].on_curve) continue;
    const std::uint32_t side = 4 * result[v].face.index + curve_corner_[v], across = mesh_.opposite(side);
    if (across == kNone || across > side) continue;
    result[v].weights = on_side(across & 3, result[v].weights[static_cast<int>(curve_corner_[v])]);
    result[v].face = FaceId(across >> 2);
  }
  for (std::uint32_t f = mesh_.face_capacity(); f-- > 0;) {
    if (!mesh_.face_alive(f)) continue;
    for (std::uint32_t k = 0; k < 3; ++k)
      result[mesh_.origin(mesh_.start(4 * f + k))] = {.face = FaceId(f), .weights = on_side(k, 0), .on_curve = false};
  }
  return result;
}

}  // namespace etalon::simplify
