#include "validation/diff/defect_patterns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "validation/texel_explainer.h"
#include "validation/texel_lookup.h"

namespace etalon::validation {
namespace {

// A pattern is told where it holds most of its own texels and leaves nearly all others alone.
constexpr double kInside = 0.4, kOutside = 0.05;
// Of other content all over, that much shows.
constexpr double kThroughout = 0.75;
// Fewer texels lie together by chance.
constexpr std::size_t kFewest = 16;

// A texel of the frame that shows a triangle, and of which image it is looked up at uv.
struct Seen {
  int x = 0, y = 0;
  std::uint32_t image = kNoImage;  // of other shadings none
  int i = 0, j = 0;                // of the image, as nearest lookup chooses
  float footprint = 0;             // texels of the image from one texel of the frame to the next
  bool wrong = false;
};

bool is_wrong(const Image& classes, int x, int y) {
  return *classes.channels<std::uint8_t>(x, y) == static_cast<std::uint8_t>(TexelClass::unexplained);
}

std::vector<Seen> seen_texels(const DrawList& list, const Frame& frame, const Image& classes, Renderer& exact) {
  Frame notes = frame;
  notes.targets = {
      {TargetContent::triangle_id, kR32ui, {}}, {TargetContent::coordinate, kRg32f, {}}, {TargetContent::bound_terms, kRg32f, {}}};
  const std::vector<Image> drawn = exact.render(list, notes);
  std::vector<Seen> seen;
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const std::uint32_t triangle = *drawn[0].channels<std::uint32_t>(x, y);
      if (triangle == kNoTriangle) continue;
      const Draw& draw = list.draw_of(triangle);
      if (draw.shading != Shading::texture) {
        seen.push_back({.x = x, .y = y, .wrong = is_wrong(classes, x, y)});
        continue;
      }
      const Image& image = *list.images[draw.texture];
      const float* uv = drawn[1].channels<float>(x, y);
      const auto index = [](float u, int n, Wrap wrap) {
        return wrap_index(static_cast<std::int64_t>(std::floor(static_cast<double>(u) * n)), n, wrap);
      };
      seen.push_back({x, y, draw.texture, index(uv[0], image.width(), draw.sampler.wrap_u),
                      index(uv[1], image.height(), draw.sampler.wrap_v), drawn[2].channels<float>(x, y)[0], is_wrong(classes, x, y)});
    }
  }
  return seen;
}

struct Share {
  std::size_t all = 0, wrong = 0;
  void add(bool is_wrong_one) { ++all, wrong += is_wrong_one ? 1 : 0; }
  [[nodiscard]] double value() const { return all == 0 ? 0 : static_cast<double>(wrong) / static_cast<double>(all); }
};

// Inside and outside told apart by `is_inside`, where that says something.
template <class Range, class IsInside>
std::string contrast(const Range& texels, IsInside&& is_inside) {
  Share in, out;
  for (const auto& texel : texels) (is_inside(texel) ? in : out).add(texel.wrong);
  if (in.value() < kInside || out.value() > kOutside * in.value() || out.all < std::max(kFewest, texels.size() / 20)) return "";
  return fmt::format("{:.3g} % of the texels there, {:.3g} % of the others", 100 * in.value(), 100 * out.value());
}

// Bounds that hold all but one in forty of the values at either end.
template <class Value>
std::pair<Value, Value> middle(std::vector<Value> values) {
  std::sort(values.begin(), values.end());
  const std::size_t cut = values.size() / 40;
  return {values[cut], values[values.size() - 1 - cut]};
}

void tell_of_image(const std::vector<Seen>& texels, std::uint32_t image, std::vector<std::string>& told) {
  std::vector<Seen> own;
  std::vector<int> i, j;
  std::vector<float> footprints;
  for (const Seen& texel : texels) {
    if (texel.image != image) continue;
    own.push_back(texel);
    if (texel.wrong) i.push_back(texel.i), j.push_back(texel.j), footprints.push_back(texel.footprint);
  }
  if (i.size() < kFewest) return;
  const std::size_t before = told.size();
  const auto [i0, i1] = middle(i);
  const auto [j0, j1] = middle(j);
  const std::string region = contrast(own, [&](const Seen& t) { return t.i >= i0 - 1 && t.i <= i1 + 1 && t.j >= j0 - 1 && t.j <= j1 + 1; });
  if (!region.empty())
    told.push_back(
        fmt::format("they lie in x {} to {}, y {} to {} of image {} ({}): a part of it has other content", i0, i1, j0, j1, image, region));
  if (told.size() > before) return;
  const auto [low, high] = middle(footprints);
  const std::string size = contrast(own, [&](const Seen& t) { return t.footprint >= low && t.footprint <= high; });
  if (!size.empty())
    told.push_back(
        fmt::format("they lie where {:.3g} to {:.3g} texels of image {} fall on one of the frame ({}): another mip level, of other "
                    "content, would do that",
                    low, high, image, size));
}

void tell_of_images(const std::vector<Seen>& texels, std::size_t images, std::size_t wrong, std::vector<std::string>& told) {
  std::vector<Share> shares(images);
  for (const Seen& texel : texels)
    if (texel.image != kNoImage) shares[texel.image].add(texel.wrong);
  std::vector<std::uint32_t> bad;
  std::size_t good = 0;
  for (std::uint32_t k = 0; k < images; ++k) {
    if (static_cast<double>(shares[k].wrong) > kOutside * static_cast<double>(wrong))
      bad.push_back(k);
    else
      good += shares[k].all;
  }
  if (bad.size() == 1 && good >= kFewest && shares[bad.front()].value() >= kInside)
    told.push_back(fmt::format("they show image {} ({:.3g} % of its texels); the other images are right", bad.front(),
                               100 * shares[bad.front()].value()));
  for (const std::uint32_t k : bad) tell_of_image(texels, k, told);
  if (!told.empty() || bad.size() != 1) return;
  const Share& share = shares[bad.front()];
  if (share.value() >= kThroughout && static_cast<double>(wrong - share.wrong) <= kOutside * static_cast<double>(wrong))
    told.push_back(fmt::format(
        "they lie all over what shows image {} ({:.3g} % of its texels): other content throughout, as of a stale texture, would do that",
        bad.front(), 100 * share.value()));
}

void tell_of_frame(const std::vector<Seen>& texels, std::vector<std::string>& told) {
  std::vector<int> xs, ys;
  for (const Seen& texel : texels)
    if (texel.wrong) xs.push_back(texel.x), ys.push_back(texel.y);
  if (xs.size() < kFewest) return;
  const auto [x0, x1] = middle(xs);
  const auto [y0, y1] = middle(ys);
  const std::string text = contrast(texels, [&](const Seen& t) { return t.x >= x0 && t.x <= x1 && t.y >= y0 && t.y <= y1; });
  if (!text.empty()) told.push_back(fmt::format("they lie in x {} to {}, y {} to {} of the frame ({})", x0, x1, y0, y1, text));
}

// Each stored value has become another one, wherever it stands: a colour curve, another colour space, a blend with one colour.
void tell_of_colours(const Image& classes, const Image& golden, const Image& candidate, std::vector<std::string>& told) {
  if (golden.format() != candidate.format() || (golden.format().type != ChannelType::unorm8 && golden.format().type != ChannelType::srgb8))
    return;
  const int channels = std::min(golden.format().channels, 3);
  std::vector<std::array<std::uint32_t, 256>> seen(static_cast<std::size_t>(channels) * 256);
  std::size_t texels = 0;
  for (int y = 0; y < golden.height(); ++y)
    for (int x = 0; x < golden.width(); ++x) {
      if (!is_wrong(classes, x, y)) continue;
      ++texels;
      for (int c = 0; c < channels; ++c)
        ++seen[static_cast<std::size_t>(256 * c + golden.channels<std::uint8_t>(x, y)[c])][candidate.channels<std::uint8_t>(x, y)[c]];
    }
  std::size_t followed = 0, pairs = 0, values = 0;
  std::string examples;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const auto most = std::max_element(seen[k].begin(), seen[k].end());
    std::size_t sum = 0;
    for (const std::uint32_t n : seen[k]) sum += n;
    if (sum == 0) continue;
    ++values;
    // Who stands alone follows any function.
    if (sum < 4) continue;
    followed += *most, pairs += sum;
    if (k / 256 == 1 && values % 16 == 0)
      examples += fmt::format("{}{} → {}", examples.empty() ? "" : ", ", k % 256, std::distance(seen[k].begin(), most));
  }
  const auto all = static_cast<double>(texels * static_cast<std::size_t>(channels));
  if (texels < kFewest || values < 12 || static_cast<double>(pairs) < 0.8 * all ||
      static_cast<double>(followed) < 0.95 * static_cast<double>(pairs))
    return;
  told.push_back(fmt::format("their colours are a function of the right ones (green: {}): a colour curve or colour space", examples));
}

}  // namespace

std::vector<std::string> defect_patterns(const DrawList& list, const Frame& frame, const Image& classes, const Image& golden,
                                         const Image& candidate, Renderer& exact) {
  std::size_t wrong = 0;
  for (int y = 0; y < classes.height(); ++y)
    for (int x = 0; x < classes.width(); ++x) wrong += is_wrong(classes, x, y) ? 1 : 0;
  std::vector<std::string> told;
  if (wrong < kFewest) return told;
  const std::vector<Seen> texels = seen_texels(list, frame, classes, exact);
  tell_of_images(texels, list.images.size(), wrong, told);
  tell_of_colours(classes, golden, candidate, told);
  if (told.empty()) tell_of_frame(texels, told);
  return told;
}

}  // namespace etalon::validation
