#include "core/adapt/cell_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "core/base/error.h"

namespace etalon::adapt {
namespace {

// By bits: −0 is not 0 here.
bool same_bits(const Vec2f& a, const Vec2f& b) {
  const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
  return bits(a.x) == bits(b.x) && bits(a.y) == bits(b.y);
}

bool stays(const CellNode& node) { return same_bits(node.before, node.after); }

constexpr std::size_t kMostByteNodes = 256;

class Writer {
 public:
  explicit Writer(std::vector<std::byte>& bytes) : bytes_(bytes) {}
  template <class T>
  void put(const T& value) {
    const auto* const first = reinterpret_cast<const std::byte*>(&value);
    bytes_.insert(bytes_.end(), first, first + sizeof value);
  }

 private:
  std::vector<std::byte>& bytes_;
};

class Reader {
 public:
  explicit Reader(const std::byte* at) : at_(at) {}
  template <class T>
  T get() {
    T value;
    std::memcpy(&value, at_, sizeof value);
    at_ += sizeof value;
    return value;
  }

 private:
  const std::byte* at_;
};

template <class Shares>
std::uint8_t index_in(const Shares& shares, double share) {
  const auto at = std::find(shares.begin(), shares.end(), share);
  ETALON_CHECK(at != shares.end(), fmt::format("share of a way: {} is none of those tried", share));
  return static_cast<std::uint8_t>(at - shares.begin());
}

void put_chart(const ChartCells& chart, Writer& out) {
  out.put(static_cast<std::uint8_t>(chart.status));
  if (chart.status != CellStatus::made) return;
  const RingCells& cells = chart.cells;
  const std::size_t count = cells.nodes.size();
  const auto first = std::find_if(cells.nodes.begin(), cells.nodes.end(), stays);
  const auto end = std::find_if_not(first, cells.nodes.end(), stays);
  const auto place = [&](auto at) { return static_cast<std::uint16_t>(at - cells.nodes.begin()); };
  out.put(static_cast<std::uint8_t>(cells.plane));
  out.put(index_of_place_share(cells.u_kept)), out.put(index_of_crossing_share(cells.crossings_kept));
  out.put(static_cast<std::uint16_t>(count)), out.put(place(first)), out.put(place(end));
  out.put(static_cast<std::uint32_t>(cells.cells.size()));
  for (auto node = cells.nodes.begin(); node != cells.nodes.end(); ++node) {
    out.put(node->before);
    if (node < first || node >= end) out.put(node->after);
  }
  for (const auto& cell : cells.cells)
    for (const std::uint16_t corner : cell) {
      if (count <= kMostByteNodes)
        out.put(static_cast<std::uint8_t>(corner));
      else
        out.put(corner);
    }
}

void get_chart(Reader& in, ChartCells& chart) {
  chart.status = static_cast<CellStatus>(in.get<std::uint8_t>());
  chart.cells.nodes.clear(), chart.cells.cells.clear();
  chart.cells.u_kept = chart.cells.crossings_kept = 1, chart.cells.plane = OverlayPlane::texture_after;
  if (chart.status != CellStatus::made) return;
  chart.cells.plane = static_cast<OverlayPlane>(in.get<std::uint8_t>());
  chart.cells.u_kept = kPlaceShares[in.get<std::uint8_t>()], chart.cells.crossings_kept = kCrossingShares[in.get<std::uint8_t>()];
  const auto count = in.get<std::uint16_t>(), first = in.get<std::uint16_t>(), end = in.get<std::uint16_t>();
  const auto cells = in.get<std::uint32_t>();
  chart.cells.nodes.reserve(count), chart.cells.cells.reserve(cells);
  for (std::uint16_t n = 0; n < count; ++n) {
    CellNode node;
    node.before = in.get<Vec2f>();
    node.after = n < first || n >= end ? in.get<Vec2f>() : node.before;
    chart.cells.nodes.push_back(node);
  }
  for (std::uint32_t c = 0; c < cells; ++c) {
    std::array<std::uint16_t, 3> cell{};
    for (std::uint16_t& corner : cell) corner = count <= kMostByteNodes ? in.get<std::uint8_t>() : in.get<std::uint16_t>();
    chart.cells.cells.push_back(cell);
  }
}

}  // namespace

std::uint8_t index_of_place_share(double share) { return index_in(kPlaceShares, share); }
std::uint8_t index_of_crossing_share(double share) { return index_in(kCrossingShares, share); }

void CellStore::put(std::size_t split, const std::vector<ChartCells>& charts) {
  ETALON_CHECK(split < size() && start_[split] == kEmpty && charts.size() <= 255, fmt::format("cells of split {} of {}", split, size()));
  start_[split] = bytes_.size();
  Writer out(bytes_);
  out.put(static_cast<std::uint8_t>(charts.size()));
  for (const ChartCells& chart : charts) put_chart(chart, out);
}

void CellStore::read(std::size_t split, std::vector<ChartCells>& charts) const {
  ETALON_CHECK(split < size(), fmt::format("cells of split {} of {}", split, size()));
  if (start_[split] == kEmpty) return charts.clear();
  Reader in(bytes_.data() + start_[split]);
  charts.resize(in.get<std::uint8_t>());
  for (ChartCells& chart : charts) get_chart(in, chart);
}

}  // namespace etalon::adapt
