#include "validation/studies/horbelt_flight_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/io/image_file.h"
#include "validation/report/json_report.h"
#include "validation/studies/svg.h"

namespace etalon::validation {
namespace {

constexpr double kLeft = 70, kWidth = 860, kTop = 20, kHeight = 190, kBarTop = 250, kBarHeight = 110;
constexpr double kEqual_db = 99;  // where nothing differs

double shown_db(const FlightFrame& frame) { return frame.psnr_db.value_or(kEqual_db); }
std::uint64_t bits_of(const FlightFrame& frame) { return frame.mesh_bits + frame.texture_bits; }
double mesh_share(const FlightFrame& frame) { return static_cast<double>(frame.mesh_bits) / static_cast<double>(bits_of(frame)); }

// PSNR as a line; below it what of each frame's bits is the mesh's, and the budget.
std::string flight_drawing(const std::vector<FlightFrame>& frames, std::uint64_t budget_bits) {
  double low = kEqual_db, high = 0;
  std::uint64_t most_bits = budget_bits;
  for (const FlightFrame& f : frames) {
    low = std::min(low, std::floor(shown_db(f))), high = std::max(high, std::ceil(shown_db(f)));
    most_bits = std::max(most_bits, bits_of(f));
  }
  if (high == low) high = low + 1;
  const double slot = kWidth / static_cast<double>(frames.size());
  const auto across = [&](std::size_t n) { return kLeft + slot * (static_cast<double>(n) + 0.5); };
  const auto up = [&](double db) { return kTop + kHeight * (1 - (db - low) / (high - low)); };
  const auto bar = [&](std::uint64_t bits) { return kBarHeight * static_cast<double>(bits) / static_cast<double>(most_bits); };

  std::string svg = svg_open(1000, 400, "PSNR of each frame, and its bits of mesh and texture");
  const double step = std::max(1.0, std::ceil((high - low) / 6));
  for (double db = low; db <= high; db += step)
    svg += svg_line({kLeft, up(db)}, {kLeft + kWidth, up(db)}, "class=\"grid\"") +
           svg_text(kLeft - 8, up(db) + 4, fmt::format("{:g} dB", db), "end", "faint");
  std::string line;
  for (std::size_t n = 0; n < frames.size(); ++n)
    line += fmt::format("{}{:.1f} {:.1f}", n == 0 ? "M" : "L", across(n), up(shown_db(frames[n])));
  svg += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#1746a2\" stroke-width=\"2\"/>", line);
  const double floor = kBarTop + kBarHeight;
  for (std::size_t n = 0; n < frames.size(); ++n) {
    const FlightFrame& f = frames[n];
    svg += svg_dot({across(n), up(shown_db(f))}, 4, "fill=\"#1746a2\"");
    const double whole = bar(bits_of(f)), mesh = bar(f.mesh_bits), width = slot * 0.7;
    svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#e08214\"/>", across(n) - width / 2,
                       floor - whole, width, whole - mesh);
    svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#5a6472\"/>", across(n) - width / 2,
                       floor - mesh, width, mesh);
    svg += svg_text(across(n), floor + 20, fmt::format("{}", n + 1), "middle", "faint");
  }
  svg += svg_line({kLeft, floor - bar(budget_bits)}, {kLeft + kWidth, floor - bar(budget_bits)}, "stroke=\"#d0312d\" stroke-width=\"1.5\"");
  svg += svg_text(kLeft - 8, floor - bar(budget_bits) + 4, "budget", "end", "faint") + svg_text(kLeft - 8, floor, "0", "end", "faint");
  return svg + "</svg>";
}

}  // namespace

StudyFigure flight_figure(const HorbeltSubjectResult& subject) {
  const std::vector<FlightFrame>& frames = subject.flight;
  const auto [low, high] = std::ranges::minmax(frames, {}, shown_db);
  StudyFigure figure{
      .id = "flight-" + subject.name,
      .title = "A flight at one budget: " + subject.name,
      .caption = fmt::format("{} frames of at most {:.1f} kbit each, as many as the first view's pair (b) of Figure 6 has: {:.2f} to "
                             "{:.2f} dB. Above: PSNR of each; below: bits of "
                             "the mesh (grey) and the texture (orange) that marginal analysis chose for its view, and the budget (red).",
                             frames.size(), static_cast<double>(subject.flight_budget_bits) / 1000, shown_db(low), shown_db(high)),
      .svg = flight_drawing(frames, subject.flight_budget_bits),
      .pictures = {},
      .columns = 4,
      .is_film = true};
  for (std::size_t n = 0; n < frames.size(); ++n) {
    const FlightFrame& f = frames[n];
    figure.pictures.push_back(
        {fmt::format("{}-flight-{:02}.png", subject.name, n + 1),
         fmt::format("frame {} of {}: mesh {} with texture {}, {:.1f} kbit, {:.0f} % of them the mesh's, {}{}", n + 1, frames.size(),
                     f.pair.mesh, f.pair.texture, static_cast<double>(bits_of(f)) / 1000, 100 * mesh_share(f),
                     f.psnr_db ? fmt::format("{:.2f} dB", *f.psnr_db) : "the same as the full pair",
                     f.is_over_budget ? " (even the smallest pair is over the budget)" : ""),
         f.picture});
  }
  const std::string sheet = subject.name + "-flight.png";
  figure.files.push_back({sheet, "all frames on one sheet", io::encode_png(contact_sheet(frames), sheet)});
  return figure;
}

StudyTable flight_table(const HorbeltStudyResult& result) {
  StudyTable table{.name = "flight",
                   .title = "A flight at one budget",
                   .note = "For each frame's view the path's last pair within the budget, which is that of the first view's Figure 6 (b).",
                   .columns = {"terrain", "frame", "mesh", "texture", "bits", "budget", "mesh %", "PSNR dB", "evaluations"},
                   .rows = {},
                   .folded = true};
  for (const HorbeltSubjectResult& subject : result.subjects)
    for (std::size_t n = 0; n < subject.flight.size(); ++n) {
      const FlightFrame& f = subject.flight[n];
      table.rows.push_back({{subject.name, {}},
                            count_cell(n + 1),
                            count_cell(f.pair.mesh),
                            count_cell(f.pair.texture),
                            count_cell(bits_of(f)),
                            count_cell(subject.flight_budget_bits),
                            number_cell(100 * mesh_share(f), 1),
                            number_cell(f.psnr_db, 2),
                            count_cell(f.evaluations)});
    }
  return table;
}

}  // namespace etalon::validation
