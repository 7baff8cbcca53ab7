#include "validation/reference/integer_judge.h"

#include <cstring>
#include <limits>

#include "validation/reference/integer_lookup.h"
#include "validation/reference/stored_number.h"

namespace etalon::validation::reference {

namespace {

// Everything that enters is a multiple of 2^-63 (an attribute or depth: 24 bits, not below 2^-40) or of 2^-43 (w: 24 bits, not below
// 2^-20), so integers hold it; b_i does not change when all w are scaled.
constexpr unsigned kAttributeBits = 63;
constexpr unsigned kWBits = 43;

// A number per vertex of the draw list's triangle.
using PerVertex = std::array<BigInt, 3>;

// E = dx·(py − a.y) − dy·(px − a.x), "with a, b the ends of an edge in counter-clockwise order, dx = b.x − a.x, dy = b.y − a.y".
struct Edge {
  std::int64_t ax, ay, dx, dy;
  [[nodiscard]] BigInt at(std::int64_t px, std::int64_t py) const { return BigInt(dx) * (py - ay) - BigInt(dy) * (px - ax); }
  [[nodiscard]] BigInt squared_length() const { return BigInt(dx) * dx + BigInt(dy) * dy; }
};

// E_i and the weights E_i·w_j·w_k of one sample, in the order of the draw list's vertices, with their sums.
struct Weights {
  PerVertex e, m;
  BigInt e_sum, m_sum;
};

void put(TexelBytes& bytes, int channel, float value) { std::memcpy(bytes.data() + 4 * channel, &value, 4); }

class IntegerJudge final : public TriangleJudge {
 public:
  IntegerJudge(const DrawList& list, const Frame& frame, std::uint32_t t)
      : list_(list), state_(frame.state), t_(t), draw_(draw_holding(list, t)) {
    for (std::size_t k = 0; k < 3; ++k) {
      const RasterVertex& vertex = list.vertices[list.triangles[t][k]];
      w_[k] = fixed_point(vertex.w, kWBits);
      z_[k] = fixed_point(as_input(vertex.z), kAttributeBits);
      for (int c = 0; c < 2; ++c) uv_[static_cast<std::size_t>(c)][k] = fixed_point(as_input(vertex.uv[c]), kAttributeBits);
      for (int c = 0; c < 4; ++c) color_[static_cast<std::size_t>(c)][k] = fixed_point(as_input(vertex.color[c]), kAttributeBits);
    }
    // "A triangle of negative area has vertices 1 and 2 exchanged first (culling is decided before: clockwise drops negative,
    // counter_clockwise positive areas). Zero area draws nothing."
    const BigInt area = edge(0, 1).at(vertex(2).x, vertex(2).y);
    const bool negative = area < 0;
    drawn_ = area != 0 && !(state_.cull == CullMode::clockwise && negative) && !(state_.cull == CullMode::counter_clockwise && !negative);
    flat_ = area == 0;
    // "E_i is the edge opposite vertex i"; with 1 and 2 exchanged the counter-clockwise edges run the other way.
    edges_ = negative ? std::array{edge(2, 1), edge(0, 2), edge(1, 0)} : std::array{edge(1, 2), edge(2, 0), edge(0, 1)};
  }

  SampleVerdict verdict(int i, int j) const override {
    SampleVerdict verdict;
    if (flat_) return verdict;
    const auto [px, py] = sample(i, j);
    bool inside = true;
    PerVertex e;
    for (std::size_t k = 0; k < 3; ++k) {
      e[k] = edges_[k].at(px, py);
      if (e[k] < 0) return {};
      // "A sample is covered if for each edge E > 0, or E = 0 and the fill rule owns the edge."
      if (e[k] == 0) {
        verdict.on_edge = true;
        if (!owns_edge(state_.fill_rule, edges_[k].dx, edges_[k].dy)) inside = false;
      }
    }
    verdict.covered = inside && drawn_;
    // "Depth is affine: Σ E_i·z_i / Σ E_i, rounded once to float32 (nearest even)."
    if (verdict.covered) verdict.depth = round_to_float32(interpolated(e, e[0] + e[1] + e[2], z_));
    return verdict;
  }

  void store(int i, int j, const std::vector<TargetSpec>& targets, std::optional<float> runner_up_depth, TexelBytes* bytes) const override {
    const Weights weights = weights_at(i, j);
    for (const TargetSpec& target : targets) *bytes++ = stored(weights, target, runner_up_depth);
  }

 private:
  [[nodiscard]] const RasterVertex& vertex(std::size_t k) const { return list_.vertices[list_.triangles[t_][k]]; }
  [[nodiscard]] Edge edge(std::size_t a, std::size_t b) const {
    const std::int64_t ax = vertex(a).x, ay = vertex(a).y, bx = vertex(b).x, by = vertex(b).y;
    return {ax, ay, bx - ax, by - ay};
  }

  // "its sample is its centre, (2i+1)·2^(b−1) sub-texels"
  [[nodiscard]] std::pair<std::int64_t, std::int64_t> sample(int i, int j) const {
    const std::int64_t half_texel = std::int64_t{1} << (state_.subtexel_bits - 1);
    return {(2 * std::int64_t{i} + 1) * half_texel, (2 * std::int64_t{j} + 1) * half_texel};
  }

  // "b_i = E_i·w_j·w_k / Σ E_i·w_j·w_k"
  [[nodiscard]] PerVertex with_w(const PerVertex& e) const { return {e[0] * w_[1] * w_[2], e[1] * w_[2] * w_[0], e[2] * w_[0] * w_[1]}; }
  [[nodiscard]] Weights weights_at(int i, int j) const {
    const auto [px, py] = sample(i, j);
    Weights weights;
    for (std::size_t k = 0; k < 3; ++k) weights.e[k] = edges_[k].at(px, py);
    weights.m = with_w(weights.e);
    weights.e_sum = weights.e[0] + weights.e[1] + weights.e[2];
    weights.m_sum = weights.m[0] + weights.m[1] + weights.m[2];
    return weights;
  }

  // "attribute = Σ b_i·a_i, an exact rational", a_i being integers of 2^-63.
  [[nodiscard]] static BigInt weighted_sum(const PerVertex& weight, const PerVertex& a) {
    return weight[0] * a[0] + weight[1] * a[1] + weight[2] * a[2];
  }
  [[nodiscard]] static Fraction interpolated(const PerVertex& weight, const BigInt& sum, const PerVertex& a) {
    return {weighted_sum(weight, a), sum << kAttributeBits};
  }
  [[nodiscard]] TextureCoordinate uv(const Weights& at) const {
    return {interpolated(at.m, at.m_sum, uv_[0]), interpolated(at.m, at.m_sum, uv_[1])};
  }

  [[nodiscard]] TexelBytes stored(const Weights& at, const TargetSpec& target, std::optional<float> runner_up_depth) const {
    switch (target.content) {
      case TargetContent::color: {
        const std::array<Fraction, 4> value = shaded(at);
        return stored_channels(value.data(), target.format);
      }
      case TargetContent::triangle_id: {
        TexelBytes bytes{};
        std::memcpy(bytes.data(), &t_, 4);
        return bytes;
      }
      case TargetContent::barycentrics: {
        const Fraction b[3] = {{at.m[0], at.m_sum}, {at.m[1], at.m_sum}, {at.m[2], at.m_sum}};
        return stored_channels(b, target.format);
      }
      case TargetContent::coordinate: {
        const TextureCoordinate coordinate = uv(at);
        const Fraction value[2] = {coordinate.u, coordinate.v};
        return stored_channels(value, target.format);
      }
      case TargetContent::depth: {
        TexelBytes bytes{};
        put(bytes, 0, stored_depth(at));
        return bytes;
      }
      case TargetContent::margins: return margins(at, runner_up_depth);
      case TargetContent::bound_terms: return bound_terms(at);
    }
    return {};
  }

  [[nodiscard]] TexelBytes stored_channels(const Fraction* value, PixelFormat format) const {
    TexelBytes bytes{};
    for (int c = 0; c < format.channels; ++c) store_channel(value[c], format, c, state_.half_rounding, bytes.data());
    return bytes;
  }

  [[nodiscard]] float stored_depth(const Weights& at) const { return round_to_float32(interpolated(at.e, at.e_sum, z_)); }

  [[nodiscard]] std::array<Fraction, 4> shaded(const Weights& at) const {
    switch (draw_.shading) {
      case Shading::vertex_color:
        return {interpolated(at.m, at.m_sum, color_[0]), interpolated(at.m, at.m_sum, color_[1]), interpolated(at.m, at.m_sum, color_[2]),
                interpolated(at.m, at.m_sum, color_[3])};
      case Shading::texture: return look_up(*list_.images[draw_.texture], draw_.sampler, uv(at));
      case Shading::indexed: {
        const TextureCoordinate second = look_up_coordinate(*list_.images[draw_.indexing_map], draw_.map_sampler, uv(at));
        return look_up(*list_.images[draw_.texture], draw_.sampler, second);
      }
    }
    return {};
  }

  // "R: distance to the nearest edge, min E_i / √(dx_i² + dy_i²), in sub-texels"
  [[nodiscard]] float nearest_edge(const Weights& at) const {
    std::size_t nearest = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      const BigInt mine = at.e[k] * at.e[k] * edges_[nearest].squared_length();
      const BigInt theirs = at.e[nearest] * at.e[nearest] * edges_[k].squared_length();
      if (mine < theirs) nearest = k;
    }
    return round_quotient_by_root(at.e[nearest], edges_[nearest].squared_length());
  }

  // "|u·width − nearest integer| [...]; linear: of u·width − ½"
  [[nodiscard]] static float border_distance(const Fraction& u, int size, Filter filter) {
    const BigInt d = 2 * u.d;
    const BigInt n = 2 * u.n * size - (filter == Filter::linear ? u.d : BigInt(0));
    const BigInt to_floor = n - floor_div(n, d) * d;
    const BigInt to_ceiling = d - to_floor;
    return round_to_float32({to_floor < to_ceiling ? to_floor : to_ceiling, d});
  }

  [[nodiscard]] TexelBytes margins(const Weights& at, std::optional<float> runner_up_depth) const {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    TexelBytes bytes{};
    put(bytes, 0, nearest_edge(at));
    const FirstLookup lookup = first_lookup(list_, draw_);
    const TextureCoordinate at_uv = uv(at);
    put(bytes, 1, lookup.image != nullptr ? border_distance(at_uv.u, lookup.image->width(), lookup.sampler.filter) : kInfinity);
    put(bytes, 2, lookup.image != nullptr ? border_distance(at_uv.v, lookup.image->height(), lookup.sampler.filter) : kInfinity);
    // "A: stored depth of the runner-up minus that of the winner", the exact difference rounded once.
    float gap = kInfinity;
    if (runner_up_depth) {
      const Fraction theirs = exact(*runner_up_depth), mine = exact(stored_depth(at));
      gap = round_to_float32({theirs.n * mine.d - mine.n * theirs.d, theirs.d * mine.d});
    }
    put(bytes, 3, gap);
    return bytes;
  }

  // |∂(s·a)/∂x| + |∂(s·a)/∂y| per texel for a = N/D with N = Σ m_i·a_i, D = Σ m_i: (N'D − ND')/D², and m' = with_w(E') where
  // ∂E/∂x = −dy, ∂E/∂y = dx per sub-texel, 2^b times that per texel.
  [[nodiscard]] Fraction gradient_norm(const PerVertex& m, const PerVertex& m_x, const PerVertex& m_y, const PerVertex& a, int size) const {
    const BigInt d = m[0] + m[1] + m[2], n = weighted_sum(m, a);
    const auto numerator = [&](const PerVertex& derivative) {
      return abs(BigInt(weighted_sum(derivative, a) * d - n * (derivative[0] + derivative[1] + derivative[2])));
    };
    const BigInt sum = numerator(m_x) + numerator(m_y);
    return {(sum * size) << state_.subtexel_bits, (d * d) << kAttributeBits};
  }

  // "R: max(|∂(u·width)/∂x| + |∂(u·width)/∂y|, |∂(v·height)/∂x| + |∂(v·height)/∂y|), [...] of the first lookup; vertex colours: 0.
  // G: |∂z/∂x| + |∂z/∂y|."
  [[nodiscard]] TexelBytes bound_terms(const Weights& at) const {
    PerVertex e_x, e_y;
    for (std::size_t k = 0; k < 3; ++k) e_x[k] = -edges_[k].dy, e_y[k] = edges_[k].dx;
    const FirstLookup lookup = first_lookup(list_, draw_);
    TexelBytes bytes{};
    put(bytes, 0, 0.0f);
    if (lookup.image != nullptr) {
      const PerVertex m_x = with_w(e_x), m_y = with_w(e_y);
      const Fraction u = gradient_norm(at.m, m_x, m_y, uv_[0], lookup.image->width());
      const Fraction v = gradient_norm(at.m, m_x, m_y, uv_[1], lookup.image->height());
      put(bytes, 0, round_to_float32(u.n * v.d > v.n * u.d ? u : v));
    }
    put(bytes, 1, round_to_float32(gradient_norm(at.e, e_x, e_y, z_, 1)));
    return bytes;
  }

  const DrawList& list_;
  const RasterState& state_;
  std::uint32_t t_;
  const Draw& draw_;
  PerVertex w_, z_;
  std::array<PerVertex, 2> uv_;
  std::array<PerVertex, 4> color_;
  bool drawn_ = false;
  bool flat_ = false;
  std::array<Edge, 3> edges_{};
};

}  // namespace

std::unique_ptr<TriangleJudge> make_integer_judge(const DrawList& list, const Frame& frame, std::uint32_t t) {
  return std::make_unique<IntegerJudge>(list, frame, t);
}

// "Clears: triangle_id 0xFFFFFFFF, depth 1, margins and bound_terms 0, the others TargetSpec::clear (stored by the rules above)."
TexelBytes integer_clear(const TargetSpec& target, HalfRounding half_rounding) {
  TexelBytes bytes{};
  switch (target.content) {
    case TargetContent::triangle_id: std::memcpy(bytes.data(), &kNoTriangle, 4); break;
    case TargetContent::depth: put(bytes, 0, 1.0f); break;
    case TargetContent::margins:
    case TargetContent::bound_terms: break;
    case TargetContent::color:
    case TargetContent::barycentrics:
    case TargetContent::coordinate:
      for (int c = 0; c < target.format.channels; ++c)
        store_channel(exact(target.clear[static_cast<std::size_t>(c)]), target.format, c, half_rounding, bytes.data());
  }
  return bytes;
}

}  // namespace etalon::validation::reference
