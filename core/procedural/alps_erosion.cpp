#include "core/procedural/alps_erosion.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "core/procedural/noise.h"
#include "core/procedural/smooth_math.h"

namespace etalon::procedural {

namespace {

constexpr int kSize = kReliefSize, kCells = kSize * kSize, kSteps = 50;
constexpr double kStep_ka = 30;  ///< thousands of years
constexpr double kUplift_m_per_ka = 0.86, kErosion = 0.010, kTalus = 1.5, kCreep = 0.2;
constexpr double kLakeRise_m = 30;

bool on_border(int cell) {
  const int x = cell % kSize, y = cell / kSize;
  return x == 0 || y == 0 || x == kSize - 1 || y == kSize - 1;
}

// Body(neighbour, distance in metres), the eight of an inner cell in a fixed order.
template <class Body>
void for_each_neighbour(int cell, const Body& body) {
  const int x = cell % kSize, y = cell / kSize;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      if ((dx == 0 && dy == 0) || x + dx < 0 || y + dy < 0 || x + dx >= kSize || y + dy >= kSize) continue;
      body(cell + dy * kSize + dx, (dx != 0 && dy != 0 ? std::sqrt(2.0) : 1.0) * kReliefSpacing_m);
    }
}

struct Drainage {
  std::vector<int> order;     ///< each cell after its receiver
  std::vector<int> receiver;  ///< −1 on the border
};

// Where a cell's water goes, among lower cells that the flood reached before: the steepest, each slope times a chance factor in [1, 1.5).
int steepest(const std::vector<double>& height, const std::vector<double>& level, int cell, std::uint64_t seed) {
  int best = -1;
  double most = 0;
  int n = 0;
  for_each_neighbour(cell, [&](int next, double run) {
    ++n;
    if (!(level[next] < height[cell])) return;
    const double chance = static_cast<double>(lattice_hash(cell, n, 0, seed) >> 11) * 0x1p-53;
    const double slope = (height[cell] - height[next]) / run * (1 + 0.5 * chance);
    if (slope > most) most = slope, best = next;
  });
  return best;
}

Drainage drain(const std::vector<double>& height, std::uint64_t seed) {
  struct Open {
    double level;
    int cell;
    bool operator>(const Open& other) const { return level != other.level ? level > other.level : cell > other.cell; }
  };
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  std::vector<double> level(kCells, 1e9);
  Drainage drainage;
  drainage.receiver.assign(kCells, -2);
  for (int cell = 0; cell < kCells; ++cell)
    if (on_border(cell)) {
      drainage.receiver[cell] = -1;
      open.push({height[cell], cell});
    }
  while (!open.empty()) {
    const Open now = open.top();
    open.pop();
    level[now.cell] = now.level;
    drainage.order.push_back(now.cell);
    if (drainage.receiver[now.cell] >= 0 && now.level == height[now.cell]) {
      const int lower = steepest(height, level, now.cell, seed);
      if (lower >= 0) drainage.receiver[now.cell] = lower;
    }
    for_each_neighbour(now.cell, [&](int next, double) {
      if (drainage.receiver[next] != -2) return;
      drainage.receiver[next] = now.cell;
      open.push({std::max(now.level, height[next]), next});
    });
  }
  return drainage;
}

std::vector<double> flow_of(const Drainage& drainage) {
  std::vector<double> flow(kCells, 1.0);
  for (auto cell = drainage.order.rbegin(); cell != drainage.order.rend(); ++cell)
    if (drainage.receiver[*cell] >= 0) flow[drainage.receiver[*cell]] += flow[*cell];
  return flow;
}

double distance(int a, int b) { return ((a % kSize != b % kSize && a / kSize != b / kSize) ? std::sqrt(2.0) : 1.0) * kReliefSpacing_m; }

// Hard rock stands, soft rock goes; and the range rises more here than there.
struct Ground {
  std::vector<double> uplift, erosion;
};
Ground ground(std::uint64_t seed) {
  Ground result{std::vector<double>(kCells), std::vector<double>(kCells)};
  for (int cell = 0; cell < kCells; ++cell) {
    const Vec3d p{(cell % kSize) / 110.0, (cell / kSize) / 110.0, 0.37};
    const double broad = value_noise(p, seed + 11), hard = fractal_noise(Vec3d(p.x * 4, p.y * 4, 0.5), 3, seed + 12);
    result.uplift[cell] = kUplift_m_per_ka * kStep_ka * (1 + 0.45 * broad);
    result.erosion[cell] = kErosion * kStep_ka * (1 + 0.5 * clamp01(0.5 + hard) - 0.25);
  }
  return result;
}

void erode(std::vector<double>& height, const Drainage& drainage, const std::vector<double>& flow, const Ground& ground) {
  for (const int cell : drainage.order) {
    const int receiver = drainage.receiver[cell];
    if (receiver < 0) continue;
    const double run = distance(cell, receiver), base = height[receiver];
    const double raised = height[cell] + ground.uplift[cell];
    const double area = flow[cell] * kReliefSpacing_m * kReliefSpacing_m;
    const double power = ground.erosion[cell] * std::sqrt(area) / run;
    const double cut = raised > base ? (raised + power * base) / (1 + power) : std::min(base, raised + 4);
    height[cell] = std::min(cut, base + kTalus * run);
  }
}

void creep(std::vector<double>& height) {
  const std::vector<double> before = height;
  for (int cell = 0; cell < kCells; ++cell) {
    if (on_border(cell)) continue;
    const double around = before[cell - 1] + before[cell + 1] + before[cell - kSize] + before[cell + kSize];
    height[cell] = before[cell] + kCreep * (around - 4 * before[cell]);
  }
}

bool in_inner(int cell, int keep) {
  const int x = cell % kSize - kReliefMargin, y = cell / kSize - kReliefMargin;
  return x >= keep && y >= keep && x < kReliefInner - keep && y < kReliefInner - keep;
}

Vec2d inner_place(int cell) { return {cell % kSize - kReliefMargin, cell / kSize - kReliefMargin}; }

// The cell of the inner square, away from its border, through which most water flows.
int outlet_of(const Relief& relief) {
  int outlet = -1;
  for (int cell = 0; cell < kCells; ++cell)
    if (in_inner(cell, 50) && (outlet < 0 || relief.flow[cell] > relief.flow[outlet])) outlet = cell;
  return outlet;
}

// The main river through the outlet, downstream: up from there always the larger stream, while it has 300 cells behind it.
std::vector<int> river_through(const Relief& relief, const Drainage& drainage, int outlet) {
  std::vector<int> river;
  for (int cell = outlet; cell >= 0;) {
    river.push_back(cell);
    int best = -1;
    for_each_neighbour(cell, [&](int next, double) {
      if (drainage.receiver[next] == cell && (best < 0 || relief.flow[next] > relief.flow[best])) best = next;
    });
    cell = best >= 0 && relief.flow[best] >= 300 ? best : -1;
  }
  std::reverse(river.begin(), river.end());
  for (int cell = drainage.receiver[outlet]; cell >= 0; cell = drainage.receiver[cell]) river.push_back(cell);
  return river;
}

// What a glacier leaves: a floor, and walls that steepen away from it.
double trough_m(double away_m) {
  constexpr double kFloor_m = 90, kWall_m = 430;
  if (away_m <= kFloor_m) return 0.02 * away_m;
  const double out = away_m - kFloor_m;
  return 0.02 * away_m + out * out / kWall_m;
}

void carve_trough(Relief& relief, const std::vector<int>& river) {
  // The river's own steps would show in its walls: heights along it are means.
  std::vector<double> along(river.size());
  for (std::size_t n = 0; n < river.size(); ++n) {
    double sum = 0;
    int count = 0;
    for (std::size_t m = n < 6 ? 0 : n - 6; m < std::min(river.size(), n + 7); ++m, ++count) sum += relief.height_m[river[m]];
    along[n] = sum / count;
  }
  for (int cell = 0; cell < kCells; ++cell) {
    double lowest = relief.height_m[cell];
    const double x = cell % kSize, y = cell / kSize;
    const double wobble = 1 + 0.25 * fractal_noise(Vec3d(x / 14, y / 14, 0.5), 3, 77);
    for (std::size_t n = 0; n < river.size(); ++n) {
      const double dx = river[n] % kSize - x, dy = river[n] / kSize - y;
      if (dx * dx + dy * dy > 40 * 40) continue;
      lowest = std::min(lowest, along[n] + trough_m(std::sqrt(dx * dx + dy * dy) * kReliefSpacing_m * wobble));
    }
    relief.height_m[cell] = lowest;
  }
}

// The valley above the outlet is levelled as far as it rises by kLakeRise_m.
void make_lake(Relief& relief, const Drainage& drainage, int outlet) {
  relief.lake.assign(kCells, 0.0);
  relief.lake_level_m = relief.height_m[outlet];
  std::vector<std::uint8_t> above(kCells, 0);
  above[outlet] = 1;
  for (const int cell : drainage.order) {
    const int receiver = drainage.receiver[cell];
    if (receiver >= 0 && above[receiver] != 0 && relief.height_m[cell] < relief.lake_level_m + kLakeRise_m) above[cell] = 1;
    if (above[cell] == 0) continue;
    relief.lake[cell] = 1;
    relief.height_m[cell] = relief.lake_level_m;
  }
}

}  // namespace

Relief make_relief(std::uint64_t seed, const std::function<void(int, int)>& progress) {
  Relief relief;
  relief.height_m.resize(kCells);
  for (int cell = 0; cell < kCells; ++cell) {
    const Vec3d p{(cell % kSize) / 60.0, (cell / kSize) / 60.0, 0.5};
    relief.height_m[cell] = on_border(cell) ? 0 : 60 + 50 * fractal_noise(p, 6, seed);
  }
  const Ground here = ground(seed);
  Drainage drainage;
  for (int step = 0; step < kSteps; ++step) {
    if (progress) progress(step, kSteps);
    drainage = drain(relief.height_m, seed + 100 + static_cast<std::uint64_t>(step));
    erode(relief.height_m, drainage, flow_of(drainage), here);
    creep(relief.height_m);
  }
  drainage = drain(relief.height_m, seed + 99);
  relief.flow = flow_of(drainage);
  carve_trough(relief, river_through(relief, drainage, outlet_of(relief)));
  for (int n = 0; n < 4; ++n) creep(relief.height_m);
  drainage = drain(relief.height_m, seed + 98);
  relief.flow = flow_of(drainage);
  const int outlet = outlet_of(relief);
  for (const int cell : river_through(relief, drainage, outlet))
    if (in_inner(cell, 0)) relief.river.push_back(inner_place(cell));
  make_lake(relief, drainage, outlet);
  return relief;
}

}  // namespace etalon::procedural
