// Quadrics of position and attributes, against distances worked out directly.
#include "core/simplify/attribute_quadric.h"

#include <doctest/doctest.h>

#include "core/base/error.h"
#include "core/simplify/hoppe_metric.h"
#include "core/simplify/qem5_metric.h"
#include "core/simplify/qem6_metric.h"
#include "core/simplify/simplify.h"
#include "tests/simplify/sample_meshes.h"

using namespace etalon;
using namespace etalon::simplify;
using namespace etalon::test;

namespace {

using Step6 = AttributeStep<3>;

double dot(const Step6& a, const Step6& b) {
  double sum = 0;
  for (std::size_t i = 0; i < 6; ++i) sum += a.x[i] * b.x[i];
  return sum;
}

/// Squared distance of p to the plane through 0, a, b: by the Gram determinants of (a, b, p) and (a, b).
double squared_distance_to_span(const Step6& a, const Step6& b, const Step6& p) {
  const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), ap = dot(a, p), bp = dot(b, p), pp = dot(p, p);
  const double gram3 = aa * (bb * pp - bp * bp) - ab * (ab * pp - bp * ap) + ap * (ab * bp - bb * ap);
  return gram3 / (aa * bb - ab * ab);
}

Step6 random_step(Rng& rng) {
  Step6 step;
  for (double& x : step.x) x = rng.uniform(-1, 1);
  return step;
}

Step6 plus(const Step6& a, const Step6& b) {
  Step6 sum;
  for (std::size_t i = 0; i < 6; ++i) sum.x[i] = a.x[i] + b.x[i];
  return sum;
}

Mesh coloured(Mesh mesh, std::uint64_t seed) {
  Rng rng(seed);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) mesh.colors.push_back({rng.uniform(0, 1), rng.uniform(0, 1), rng.uniform(0, 1), 1});
  return mesh;
}

}  // namespace

TEST_CASE("equation 12: the squared distance to the plane of a triangle in six dimensions") {
  Rng rng(3);
  for (int i = 0; i < 100; ++i) {
    const Step6 a = random_step(rng), b = random_step(rng), p = random_step(rng);
    AttributeQuadric<double, 3> q;
    add_triangle_at_origin(q, a, b, 2);
    CHECK(evaluate(q, p) == doctest::Approx(2 * squared_distance_to_span(a, b, p)).epsilon(1e-12));
    CHECK(evaluate(q, a) == doctest::Approx(0).epsilon(1e-13));
    CHECK(total_weight(q) == doctest::Approx(2).epsilon(1e-14));
  }
}

TEST_CASE("sides of one direction span no plane") {
  AttributeQuadric<double, 3> q;
  Step6 a;
  a.x = {1, 2, 3, 0, 1, 0};
  Step6 twice = plus(a, a);
  add_triangle_at_origin(q, a, twice, 1);
  add_triangle_at_origin(q, a, Step6{}, 1);
  add_triangle_at_origin(q, Step6{}, a, 1);
  CHECK(total_weight(q) == 0);
}

TEST_CASE("measured from another point: the same distances; sums add them") {
  Rng rng(4);
  const Step6 a = random_step(rng), b = random_step(rng), c = random_step(rng), shift = random_step(rng), p = random_step(rng);
  AttributeQuadric<double, 3> q, other;
  add_triangle_at_origin(q, a, b, 1);
  add_triangle_at_origin(other, b, c, 3);
  const AttributeQuadric<double, 3> both = moved_sum(q, other, shift);
  CHECK(evaluate(both, p) == doctest::Approx(evaluate(q, p) + evaluate(other, plus(shift, p))).epsilon(1e-13));
  HoppeQuadric<double, 3> h, h_other;
  add_triangle_at_origin(h, a, b, 1);
  add_triangle_at_origin(h_other, b, c, 3);
  const HoppeQuadric<double, 3> h_both = moved_sum(h, h_other, shift);
  CHECK(evaluate(h_both, p) == doctest::Approx(evaluate(h, p) + evaluate(h_other, plus(shift, p))).epsilon(1e-13));
}

TEST_CASE("hoppe: the distance to the plane, and from the colour that the face has below") {
  // Face in z = 0, red = x, green = 2y, blue = 0 from its corner at the origin.
  HoppeQuadric<double, 3> q;
  const Step6 side1{{2, 0, 0, 2, 0, 0}}, side2{{1, 1, 0, 1, 2, 0}};
  add_triangle_at_origin(q, side1, side2, 2);
  CHECK(evaluate(q, Step6{{5, 7, 0, 5, 14, 0}}) == doctest::Approx(0).epsilon(1e-12));
  CHECK(evaluate(q, Step6{{5, 7, 3, 5, 14, 0}}) == doctest::Approx(2 * 9).epsilon(1e-14));
  CHECK(evaluate(q, Step6{{5, 7, 0, 6, 12, 0.5}}) == doctest::Approx(2 * (1 + 4 + 0.25)).epsilon(1e-14));
  CHECK(total_weight(q) == 2);
  const double before = q.w;
  add_triangle_at_origin(q, side1, side1, 1);  // no face
  CHECK(q.w == before);
}

template <class Quadric>
void check_minimum(std::uint64_t seed) {
  Rng rng(seed);
  for (int i = 0; i < 50; ++i) {
    Quadric q;
    for (int k = 0; k < 6; ++k) {
      Quadric part;
      add_triangle_at_origin(part, random_step(rng), random_step(rng), 1);
      q = moved_sum(q, part, random_step(rng));
    }
    Quadric reduced = q;
    REQUIRE(eliminate_attributes(reduced, 1e-9));
    const std::optional<Vec3d> d = minimum(position_part(reduced), 1e-9);
    REQUIRE(d.has_value());
    const Step6 best = step_of<3>(*d, best_attributes(reduced, *d));
    const double least = evaluate(q, best);
    // The reduced quadric has the same least value; and no step from there is downhill.
    CHECK(least == doctest::Approx(evaluate(position_part(reduced), *d)).epsilon(1e-9));
    for (int k = 0; k < 20; ++k) {
      Step6 away = random_step(rng);
      for (double& x : away.x) x *= 0.01;
      CHECK(evaluate(q, plus(best, away)) > least);
    }
  }
}

TEST_CASE("the minimum: attributes taken out, position solved, attributes back") {
  check_minimum<AttributeQuadric<double, 3>>(5);
  check_minimum<HoppeQuadric<double, 3>>(6);
}

TEST_CASE("what a quadric leaves open is said to be open") {
  Quadric3<double> flat;
  add_plane_at_origin(flat, {0, 0.6, 0.8}, 1);
  CHECK_FALSE(minimum(flat, 1e-9).has_value());
  add_plane_at_origin(flat, {0, 1, 0}, 1);
  CHECK_FALSE(minimum(flat, 1e-9).has_value());
  add_plane_at_origin(flat, {1, 0, 0}, 1);
  CHECK(minimum(flat, 1e-9).has_value());
  AttributeQuadric<double, 3> none;
  CHECK_FALSE(eliminate_attributes(none, 0));
  HoppeQuadric<double, 3> nothing;
  CHECK_FALSE(eliminate_attributes(nothing, 0));
}

TEST_CASE("state: 112, 92, 84 bytes; each coefficient rounded once") {
  CHECK(sizeof(AttributeQuadric<float, 3>) == 28 * 4);
  CHECK(sizeof(HoppeQuadric<float, 3>) == 23 * 4);
  CHECK(sizeof(AttributeQuadric<float, 2>) == 21 * 4);
  const Mesh sphere = coloured(bumpy_sphere(6, 0.3f, 5), 1);
  CHECK(simplify_mesh(sphere, {.metric = MetricName::qem6, .target_faces = 80}).state_bytes_per_vertex == 112);
  CHECK(simplify_mesh(sphere, {.metric = MetricName::hoppe, .target_faces = 80}).state_bytes_per_vertex == 92);
  CHECK(simplify_mesh(bumpy_grid(4, 0.1f, 1), {.metric = MetricName::qem5, .target_faces = 8}).state_bytes == 25 * 84);
}

TEST_CASE("qem6 by hand: a flat square of one triangle's colours") {
  // Two triangles in z = 0; red differs at vertex 2 only. The longest side is 1, so colours count as they are.
  Mesh mesh = square();
  mesh.colors.assign(4, {0, 0, 0, 1});
  mesh.colors[2].x = 1;
  const CollapseMesh engine(mesh, {});
  const UnitPositions positions = unit_positions(engine);
  CHECK(positions.longest == 1);
  const Qem6Metric metric(engine, positions, {.boundary_weight = 0}, 1);
  // Vertex 1's one face, (0,0) (1,0) (1,1), has red = y over itself: in (y, red) its plane is the line (1, 1)/√2. Vertex 0 at y = 0, red =
  // 0 lies in it.
  CHECK(metric.cost(1, 0, engine.first_out(1)) == doctest::Approx(0).epsilon(1e-15));
  // Twice the weight on colours: the same plane in another scale.
  const Qem6Metric heavy(engine, positions, {.boundary_weight = 0}, 2);
  CHECK(heavy.cost(1, 0, engine.first_out(1)) == doctest::Approx(0).epsilon(1e-15));
  // From vertex 0, whose faces say red = y and red = x, to vertex 1 = (1, 0), red 0: off red = x, whose plane has the normal (1, −1)/√2 in
  // (x, red).
  CHECK(metric.cost(0, 1, engine.find_edge(0, 1).left) == doctest::Approx(0.5 * 0.5).epsilon(1e-14));
}

TEST_CASE("qem5: a seam vertex costs the sum over its wedges") {
  const Mesh grid = seamed_grid(4, 0, 1);  // the seam runs along x = 0.5: vertices 2, 7, 12, 17, 22
  CollapseMesh engine(grid, {});
  const UnitPositions positions = unit_positions(engine);
  Qem5Metric metric(engine, positions, {}, 1);
  // Texture coordinates are linear on both sides and the seam is straight: no cost along it.
  const CollapseMesh::Edge along = engine.find_edge(7, 12);
  CHECK(metric.cost(7, 12, along.left) == doctest::Approx(0).epsilon(1e-15));
  // One side bent in texture: that side's faces pay. The same bend on the other side as well: both.
  const auto bent = [&](bool left, bool right) {
    Mesh source = grid;
    for (Wedge& w : source.wedges)
      if (w.vertex == VertexId(7u)) {
        const bool is_right = w.uv.x > 1;
        if (is_right ? right : left) w.uv.x += 0.05f;
      }
    const CollapseMesh mesh(source, {});
    const UnitPositions at = unit_positions(mesh);
    return Qem5Metric(mesh, at, {}, 1).cost(7, 12, mesh.find_edge(7, 12).left);
  };
  const double left = bent(true, false), right = bent(false, true), both = bent(true, true);
  CHECK(left > 1e-6);
  CHECK(right > 1e-6);
  CHECK(both == doctest::Approx(left + right).epsilon(1e-9));
}

TEST_CASE("attributes that are missing or not numbers are refused") {
  const auto message = [](const Mesh& mesh, const SimplifyOptions& options) -> std::string {
    try {
      (void)simplify_mesh(mesh, options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  CHECK(message(square(), {.metric = MetricName::qem6}) == "metric qem6: expected vertex colours, got none");
  CHECK(message(square(), {.metric = MetricName::hoppe}) == "metric hoppe: expected vertex colours, got none");
  CHECK(message(bumpy_sphere(2, 0, 1), {.metric = MetricName::qem5}) == "metric qem5: expected texture coordinates, got none");
  Mesh bad = coloured(square(), 1);
  bad.colors[3].y = std::numeric_limits<float>::infinity();
  CHECK(message(bad, {.metric = MetricName::qem6}).find("vertex 3: colour") == 0);
  CHECK(message(square(), {.attribute_weight = 0}) == "attribute weight: expected a positive number, got 0");
  CHECK_THROWS_AS((void)metric_named("qem7"), InputError);
  for (const MetricName metric : kMetricNames) CHECK(metric_named(to_string(metric)) == metric);
}
