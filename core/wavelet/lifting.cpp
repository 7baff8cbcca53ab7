#include "core/wavelet/lifting.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/parallel.h"

namespace etalon::wavelet {
namespace {

// Lines side by side: sample i of all of them is one row of `lanes` numbers. A column block is transformed as it lies, a row is a block of one
// lane; each lifting step updates every second row from its two neighbours, which vectorises without a gather.
constexpr int kLanes = 64;

constexpr double kAlpha = -1.586134342059924, kBeta = -0.052980118572961, kGamma = 0.882911075530934, kDelta = 0.443506852043971;
constexpr double kScale = 1.230174104914001;

// Two's complement, so that hostile coefficients wrap instead of being undefined.
constexpr std::int32_t add(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
}
constexpr std::int32_t subtract(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b));
}

struct Predict {  // x − ⌊(a + b)/2⌋, or back
  bool back;
  std::int32_t operator()(std::int32_t x, std::int32_t a, std::int32_t b) const {
    const std::int32_t half = add(a, b) >> 1;
    return back ? add(x, half) : subtract(x, half);
  }
};
struct Update {  // x + ⌊(a + b + 2)/4⌋, or back
  bool back;
  std::int32_t operator()(std::int32_t x, std::int32_t a, std::int32_t b) const {
    const std::int32_t quarter = add(add(a, b), 2) >> 2;
    return back ? subtract(x, quarter) : add(x, quarter);
  }
};
struct Step {  // x + factor·(a + b)
  double factor;
  double operator()(double x, double a, double b) const { return x + factor * (a + b); }
};

// Applies `step` to the samples first, first + 2, … of n >= 2; beyond an end the line is mirrored about its last sample.
template <class T, class F>
void lift(T* x, std::ptrdiff_t lanes, int n, int first, F step) {
  for (int i = first; i < n; i += 2) {
    T* at = x + i * lanes;
    const T* before = x + (i > 0 ? i - 1 : 1) * lanes;
    const T* after = x + (i + 1 < n ? i + 1 : n - 2) * lanes;
    for (std::ptrdiff_t k = 0; k < lanes; ++k) at[k] = step(at[k], before[k], after[k]);
  }
}

void multiply(double* x, std::ptrdiff_t lanes, int n, double even, double odd) {
  for (int i = 0; i < n; ++i)
    for (std::ptrdiff_t k = 0; k < lanes; ++k) x[i * lanes + k] *= i % 2 == 0 ? even : odd;
}

void forward_lines(std::int32_t* x, std::ptrdiff_t lanes, int n) {
  lift(x, lanes, n, 1, Predict{false});
  lift(x, lanes, n, 0, Update{false});
}
void inverse_lines(std::int32_t* x, std::ptrdiff_t lanes, int n) {
  lift(x, lanes, n, 0, Update{true});
  lift(x, lanes, n, 1, Predict{true});
}
void forward_lines(double* x, std::ptrdiff_t lanes, int n) {
  lift(x, lanes, n, 1, Step{kAlpha});
  lift(x, lanes, n, 0, Step{kBeta});
  lift(x, lanes, n, 1, Step{kGamma});
  lift(x, lanes, n, 0, Step{kDelta});
  multiply(x, lanes, n, 1 / kScale, kScale / 2);
}
void inverse_lines(double* x, std::ptrdiff_t lanes, int n) {
  multiply(x, lanes, n, kScale, 2 / kScale);
  lift(x, lanes, n, 0, Step{-kDelta});
  lift(x, lanes, n, 1, Step{-kGamma});
  lift(x, lanes, n, 0, Step{-kBeta});
  lift(x, lanes, n, 1, Step{-kAlpha});
}

// Interleaved sample i <-> its place in the line of low half, high half.
constexpr int place(int i, int n) { return i % 2 == 0 ? i / 2 : (n + 1) / 2 + i / 2; }

template <class T>
void transform_columns(Plane<T>& plane, int w, int h, bool back) {
  if (h < 2) return;
  parallel_for_blocks(static_cast<std::size_t>(w), kLanes, [&](std::size_t begin, std::size_t end) {
    const auto lanes = static_cast<std::ptrdiff_t>(end - begin);
    std::vector<T> block(static_cast<std::size_t>(lanes) * static_cast<std::size_t>(h));
    for (int i = 0; i < h; ++i) std::copy_n(plane.row(back ? place(i, h) : i) + begin, lanes, block.data() + i * lanes);
    back ? inverse_lines(block.data(), lanes, h) : forward_lines(block.data(), lanes, h);
    for (int i = 0; i < h; ++i) std::copy_n(block.data() + i * lanes, lanes, plane.row(back ? i : place(i, h)) + begin);
  });
}

template <class T>
void transform_rows(Plane<T>& plane, int w, int h, bool back) {
  if (w < 2) return;
  parallel_for_blocks(static_cast<std::size_t>(h), 16, [&](std::size_t begin, std::size_t end) {
    std::vector<T> line(static_cast<std::size_t>(w));
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      T* row = plane.row(y);
      const int low = (w + 1) / 2;
      if (back) {
        for (int i = 0; i < low; ++i) line[static_cast<std::size_t>(2 * i)] = row[i];
        for (int i = 0; i < w / 2; ++i) line[static_cast<std::size_t>(2 * i + 1)] = row[low + i];
        inverse_lines(line.data(), 1, w);
        std::copy(line.begin(), line.end(), row);
      } else {
        std::copy_n(row, w, line.begin());
        forward_lines(line.data(), 1, w);
        for (int i = 0; i < low; ++i) row[i] = line[static_cast<std::size_t>(2 * i)];
        for (int i = 0; i < w / 2; ++i) row[low + i] = line[static_cast<std::size_t>(2 * i + 1)];
      }
    }
  });
}

template <class T>
void forward_levels(Plane<T>& plane, int levels) {
  for (int l = 0; l < levels; ++l) {
    const int w = low_size(plane.width, l), h = low_size(plane.height, l);
    transform_columns(plane, w, h, false);
    transform_rows(plane, w, h, false);
  }
}
template <class T>
void inverse_levels(Plane<T>& plane, int levels) {
  for (int l = levels - 1; l >= 0; --l) {
    const int w = low_size(plane.width, l), h = low_size(plane.height, l);
    transform_rows(plane, w, h, true);
    transform_columns(plane, w, h, true);
  }
}

}  // namespace

void forward(Plane<std::int32_t>& plane, int levels) { forward_levels(plane, levels); }
void inverse(Plane<std::int32_t>& plane, int levels) { inverse_levels(plane, levels); }
void forward(Plane<double>& plane, int levels) { forward_levels(plane, levels); }
void inverse(Plane<double>& plane, int levels) { inverse_levels(plane, levels); }

// Let u = 2^-53 and all norms be maximum norms. Inside a line a step x + c(a + b) of numbers up to m errs by at most 3u(1 + 2|c|)m: one rounding
// each of sum, product and sum; errors and magnitudes before it grow by at most 1 + 2|c|. That gives what one line, forwards or back, errs by.
// As a whole an exact line forwards enlarges by at most A, one back by at most S (kAnalysisGain, kSynthesisGain; a test sums the filters'
// absolute values), so the numbers before line j = 1, 2, … are at most A^(j-1)·magnitude. What line j errs by forwards goes through the exact
// inverse of lines j..1, and what its inverse errs by through that of the lines before it. Second-order terms are covered by the last factor.
double roundtrip_error_bound(int levels, double magnitude) {
  constexpr double kUnit = 0x1p-53;
  struct Line {
    double m = 1, error = 0;
    void step(double c) {
      error = (1 + 2 * std::abs(c)) * error + 3 * kUnit * (1 + 2 * std::abs(c)) * m;
      m *= 1 + 2 * std::abs(c);
    }
    void scale(double factor) {
      error = factor * error + 2 * kUnit * factor * m;
      m *= factor;
    }
  } there, back;
  for (const double c : {kAlpha, kBeta, kGamma, kDelta}) there.step(c);
  there.scale(std::max(1 / kScale, kScale / 2));
  back.scale(std::max(kScale, 2 / kScale));
  for (const double c : {kDelta, kGamma, kBeta, kAlpha}) back.step(c);

  double sum = 0, before = magnitude, outward = 1;  // A^(j-1)·magnitude, S^(j-1)
  for (int j = 1; j <= 2 * levels; ++j) {
    sum += (there.error * before * kSynthesisGain + back.error * before * kAnalysisGain) * outward;
    before *= kAnalysisGain;
    outward *= kSynthesisGain;
  }
  return sum * (1 + 0x1p-20);
}

void inverse_line(std::span<double> line, Kernel kernel) {
  const int n = static_cast<int>(line.size());
  if (n < 2) return;
  std::vector<double> x(line.size());
  for (int i = 0; i < n; ++i) x[static_cast<std::size_t>(i)] = line[static_cast<std::size_t>(place(i, n))];
  if (kernel == Kernel::irreversible_9_7) {
    inverse_lines(x.data(), 1, n);
  } else {
    lift(x.data(), 1, n, 0, Step{-0.25});
    lift(x.data(), 1, n, 1, Step{0.5});
  }
  std::copy(x.begin(), x.end(), line.begin());
}

}  // namespace etalon::wavelet
