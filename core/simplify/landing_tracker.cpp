#include "core/simplify/landing_tracker.h"

#include <algorithm>
#include <cmath>
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

Vec3d on_segment(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const double t = nearest_on_segment(p, a, b);
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)};
}

}  // namespace

LandingTracker::LandingTracker(const CollapseMesh& mesh)
    : mesh_(mesh),
      landings_(mesh.source().vertex_count()),
      head_(mesh.face_capacity(), kNone),
      next_(mesh.source().vertex_count(), kNone),
      curve_corner_(mesh.source().vertex_count(), 0),
      followed_(mesh.source().vertex_count(), false) {
  double largest = 0;
  for (const Vec3f& p : mesh.source().positions) largest = std::max<double>({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  slack_ = 0x1p-48 * largest;
}

void LandingTracker::plan(std::uint32_t u, const CollapseMesh::Edge& edge, const Vec3f* at) {
  u_ = u;
  v_ = edge.left != kNone ? mesh_.end(edge.left) : mesh_.start(edge.right);
  edge_ = edge;
  moves_ = at != nullptr;
  at_ = to_double(moves_ ? *at : mesh_.position(v_));
  moving_.clear();
  emptied_.clear();
  for (auto& faces : faces_) faces.clear();

  const bool on_curve = mesh_.kind(u) == VertexKind::curve;
  const int u_side = edge.left != kNone ? 0 : 1;
  take_faces(u, edge.left != kNone ? edge.left : mesh_.first_out(u), u_side);
  if (moves_) take_faces(v_, edge.right != kNone ? edge.right : mesh_.first_out(v_), on_curve && edge.right != kNone ? 1 : u_side);
  // A side of one face, which goes: what lies behind its third edge, which is on no curve, takes its place.
  if (edge.left != kNone && faces_[0].empty()) faces_[0].push_back(mesh_.opposite(CollapseMesh::next(edge.left)) >> 2);
  if (edge.right != kNone && faces_[1].empty() && on_curve) faces_[1].push_back(mesh_.opposite(CollapseMesh::previous(edge.right)) >> 2);

  take_self(u, u_side);
  if (moves_) take_self(v_, u_side);
  if (on_curve) plan_curve(u, moves_);
}

// Around w counter-clockwise from the half-edge `first`, on `side` of the curve up to its next edge, on the other behind.
void LandingTracker::take_faces(std::uint32_t w, std::uint32_t first, int side) {
  const bool turns = mesh_.kind(w) == VertexKind::curve;
  std::uint32_t h = first;
  do {
    const std::uint32_t back = CollapseMesh::previous(h), f = h >> 2;
    if (std::find(emptied_.begin(), emptied_.end(), f) == emptied_.end()) {
      emptied_.push_back(f);
      take_points(f, side);
      if (f != edge_.left >> 2 && f != edge_.right >> 2) faces_[static_cast<std::size_t>(side)].push_back(f);
    }
    if (turns && mesh_.on_curve(back)) side = 1 - side;
    h = mesh_.opposite(back);
  } while (h != kNone && h != first);
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
}

// w's own place in the input, which was a vertex of the surface until now.
void LandingTracker::take_self(std::uint32_t w, int side) {
  if (followed_[w]) return;
  Moving self{w, side};
  if (mesh_.kind(w) == VertexKind::curve) self.curve_a = self.curve_b = w;
  moving_.push_back(self);
}

// The chain a-u-v-b becomes a-v-b, or where v stays a-u-v becomes a-v: points on its changing edges go to the nearest of those.
void LandingTracker::plan_curve(std::uint32_t u, bool moves) {
  chain_.clear();
  const auto add_ends = [&](std::uint32_t w, std::uint32_t but) {
    mesh_.for_each_neighbor(w, [&](std::uint32_t n, std::uint32_t h) {
      if (mesh_.on_curve(h) && n != but) chain_.push_back(n);
    });
  };
  add_ends(u, v_);
  if (moves) add_ends(v_, u);
  for (Moving& point : moving_)
    point.on_chain =
        point.curve_a != kNone && (point.curve_a == u || point.curve_b == u || (moves && (point.curve_a == v_ || point.curve_b == v_)));
}

NearestOnTriangle LandingTracker::nearest(const Moving& point, std::uint32_t& face) const {
  const Vec3d p = input(point.vertex);
  NearestOnTriangle best;
  best.distance2 = std::numeric_limits<double>::infinity();
  face = kNone;
  for (const std::uint32_t f : faces_[static_cast<std::size_t>(point.side)]) {
    const NearestOnTriangle found =
        nearest_on_triangle(p, corner(mesh_.start(4 * f)), corner(mesh_.start(4 * f + 1)), corner(mesh_.start(4 * f + 2)));
    if (found.distance2 > best.distance2 || (found.distance2 == best.distance2 && f > face)) continue;
    best = found;
    face = f;
  }
  return best;
}

bool LandingTracker::planned_within(double distance) const {
  const double limit = distance - slack_;
  if (!(limit >= 0)) return moving_.empty();
  const double limit2 = limit * limit;
  for (const Moving& point : moving_) {
    const Vec3d p = input(point.vertex);
    double distance2 = std::numeric_limits<double>::infinity();
    std::uint32_t face = kNone;
    if (point.on_chain) {
      for (const std::uint32_t end : chain_) distance2 = std::min(distance2, squared_distance(p, on_segment(p, at_, corner(end))));
    } else if (point.curve_a != kNone) {
      distance2 = squared_distance(p, on_segment(p, corner(point.curve_a), corner(point.curve_b)));
    } else {
      distance2 = nearest(point, face).distance2;
    }
    if (!(distance2 <= limit2)) return false;
  }
  return true;
}

void LandingTracker::before() {
  for (const std::uint32_t f : emptied_) head_[f] = kNone;
  for (const Moving& point : moving_) {
    followed_[point.vertex] = true;
    if (point.curve_a != kNone) continue;
    Landing landing;
    std::uint32_t face = kNone;
    landing.weights = nearest(point, face).weights;
    landing.face = FaceId(face);
    put(point.vertex, landing);
  }
}

void LandingTracker::after() {
  for (const Moving& point : moving_)
    if (point.curve_a != kNone) land_on_edge(point);
}

void LandingTracker::put(std::uint32_t vertex, const Landing& landing) {
  landings_[vertex] = landing;
  next_[vertex] = head_[landing.face.index];
  head_[landing.face.index] = vertex;
}

// Every edge of the curve that changed, or lost its face, now has a face at v or is a side of a face that stays.
void LandingTracker::land_on_edge(const Moving& point) {
  const Vec3d p = input(point.vertex);
  Landing best{.face = {}, .weights = {0, 0, 0}, .on_curve = true};
  double distance2 = std::numeric_limits<double>::infinity();
  const auto is_its_edge = [&](std::uint32_t a, std::uint32_t b) {
    if (!point.on_chain) return (a == point.curve_a && b == point.curve_b) || (a == point.curve_b && b == point.curve_a);
    const std::uint32_t end = a == v_ ? b : a;
    return (a == v_ || b == v_) && std::find(chain_.begin(), chain_.end(), end) != chain_.end();
  };
  const auto consider = [&](std::uint32_t f) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t h = 4 * f + k, a = mesh_.start(h), b = mesh_.end(h);
      if (!mesh_.on_curve(h) || !is_its_edge(a, b)) continue;
      const Vec3d at_a = to_double(mesh_.position(a)), at_b = to_double(mesh_.position(b));
      const double t = nearest_on_segment(p, at_a, at_b), here = squared_distance(p, on_segment(p, at_a, at_b));
      if (best.face.valid() && (here > distance2 || (here == distance2 && f >= best.face.index))) continue;
      distance2 = here;
      best.face = FaceId(f);
      best.weights = on_side(k, t);
      curve_corner_[point.vertex] = static_cast<std::uint8_t>(k);
    }
  };
  const std::uint32_t first = mesh_.first_out(v_);
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
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh_.origin(mesh_.start(4 * f + k));
      if (!followed_[v]) result[v] = {.face = FaceId(f), .weights = on_side(k, 0), .on_curve = false};
    }
  }
  return result;
}

}  // namespace etalon::simplify
