#include "validation/report/html_case.h"

#include <algorithm>

#include <fmt/format.h>

#include "validation/metrics/decibel.h"
#include "validation/report/html_text.h"
#include "validation/report/json_report.h"

namespace etalon::validation {
namespace {

std::string content_title(const std::string& content) {
  if (content == "color") return "Colour";
  if (content == "triangle_id") return "Triangle";
  if (content == "depth") return "Depth";
  if (content == "coordinate") return "Coordinate";
  if (content == "barycentrics") return "Barycentrics";
  return content;
}

std::string lower_title(const std::string& content) {
  std::string title = content_title(content);
  if (title[0] >= 'A' && title[0] <= 'Z') title[0] = static_cast<char>(title[0] - 'A' + 'a');
  return title;
}

std::string picture(const std::string& css_class, const Image& image, const std::string& alt) {
  // Few texels shown large are squares, not a blur.
  const bool small = std::max(image.width(), image.height()) <= 400;
  return fmt::format("<img class=\"{}{}\" width=\"{}\" height=\"{}\" alt=\"{}\" src=\"{}\">", css_class, small ? " small" : "",
                     image.width(), image.height(), escaped(alt), png_data_uri(image));
}

// What lies over a picture that both sides drew alike: of the scene's other targets it says what differs.
std::string same_label(const CaseResult& item, const TargetResult& target) {
  std::string others;
  for (const TargetResult& other : item.targets) {
    if (!other.difference || other.difference->identical) continue;
    others += fmt::format("{} {} differs in {}", others.empty() ? ";" : ",", lower_title(other.content),
                          grouped(other.difference->differing_texels));
  }
  return others.empty() ? item.sides.exact + " = " + item.sides.device : lower_title(target.content) + " identical" + others;
}

// The page bounds a frame's height by its width: a tall one must fit the window.
std::string frame_start(const std::string& css_class, const Image& image) {
  return fmt::format("<div class=\"{}\" style=\"--ratio:{:.4f}\">", css_class,
                     static_cast<double>(image.width()) / static_cast<double>(image.height()));
}

std::string comparison(const CaseResult& item, const TargetResult& target) {
  const std::string subject = fmt::format("{} of {}", content_title(target.content), item.name());
  if (!target.difference) {
    return "<figure class=\"main\">" + frame_start("frame", target.cpu_picture) +
           picture("cpu", target.cpu_picture, subject + ", by " + item.sides.exact_long) + "<span class=\"label left\">" +
           escaped(item.sides.exact) +
           "</span></div><figcaption><span>There is no OpenGL picture to compare "
           "with.</span></figcaption></figure>";
  }
  if (target.gl_picture.empty()) {
    return "<figure class=\"main\">" + frame_start("frame", target.cpu_picture) +
           picture("cpu", target.cpu_picture, subject + ", the same bytes on both sides") + "<span class=\"label left\">" +
           escaped(same_label(item, target)) +
           "</span></div><figcaption><span>Both sides have the same bytes of this target.</span></figcaption></figure>";
  }
  return "<figure class=\"main\">" + frame_start("frame slider", target.cpu_picture) +
         picture("cpu", target.cpu_picture, subject + ", by " + item.sides.exact_long) + "<div class=\"over\">" +
         picture("gl", target.gl_picture, subject + ", by " + item.sides.device_long) +
         fmt::format(
             "</div><span class=\"label left\">{}</span><span class=\"label right\">{}</span>"
             "<input type=\"range\" min=\"0\" max=\"100\" step=\"0.5\" value=\"50\" aria-label=\"Divider between {}, left, and {}, "
             "right\">",
             escaped(item.sides.exact), escaped(item.sides.device), escaped(item.sides.exact_long), escaped(item.sides.device_long)) +
         "<span class=\"handle\"></span></div><figcaption><span>Drag, or use the arrow keys. Point at a texel to see its "
         "neighbourhood.</span></figcaption></figure>";
}

std::string class_figure(const CaseResult& item) {
  if (item.class_picture.empty()) return "";
  std::string legend;
  const auto add = [&](const std::string& name, std::uint64_t count) {
    legend += fmt::format("<span>{} {}</span>", class_chip(name), grouped(count));
  };
  add("identical", item.tally.identical);
  add("rounding", item.tally.rounding);
  add("tie", item.tally.tie);
  add("unbounded", item.tally.unbounded);
  add("unexplained", item.tally.unexplained);
  return "<figure class=\"class-figure\">" + frame_start("frame", item.class_picture) +
         picture("classes", item.class_picture, "Class of every texel; those that are not identical are marked, enlarged") +
         "</div><figcaption>" + legend + "</figcaption></figure>";
}

std::string error_figure(const TargetResult& target) {
  if (target.error_picture.empty()) return "";
  return "<figure class=\"error-figure\">" + frame_start("frame", target.error_picture) +
         picture("errors", target.error_picture, "Heat map of the differences, enlarged") +
         "</div><figcaption><span>Size of each difference, dark to bright by powers of two.</span></figcaption></figure>";
}

bool is_float(ChannelType type) { return type == ChannelType::half || type == ChannelType::float32; }

std::string fact(const std::string& name, const std::string& value) {
  return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", name, value);
}

std::string facts(const TargetResult& target) {
  const ImageDifference& d = *target.difference;
  std::string list =
      fact("format", escaped(target.format)) +
      fact("texels that differ in this target",
           fmt::format("{} <span class=\"soft\">({})</span>", grouped(d.differing_texels), share(d.differing_texels, d.texels)));
  if (d.format.type == ChannelType::uint32) return "<dl class=\"facts wide\">" + list + "</dl>";
  const std::optional<double> psnr = d.psnr_db();
  list += fact("PSNR", psnr ? fmt::format("{:.2f} dB", *psnr) : "∞ (identical)");
  list += is_float(d.format.type) ? fact("squared error", fmt::format("{:.3g}", d.total.squared_error))
                                  : fact("squared error", grouped(d.total.sse));
  list +=
      fact("largest difference", is_float(d.format.type) ? fmt::format("{:.3g}", d.total.max_abs) : fmt::format("{:.0f}", d.total.max_abs));
  list += fact("first at", d.total.max_x < 0 ? "–" : fmt::format("({}, {})", d.total.max_x, d.total.max_y));
  return "<dl class=\"facts wide\">" + list + "</dl>";
}

// Bars on a logarithmic axis: one texel and a million can be seen side by side. At most 24 bars: beyond, neighbours are joined.
std::vector<HistogramBin> shown_bins(const std::vector<HistogramBin>& bins) {
  std::vector<HistogramBin> shown;
  for (const HistogramBin& bin : bins) {
    if (bin.low != 0) shown.push_back(bin);
  }
  while (shown.size() > 24) {
    std::vector<HistogramBin> joined;
    for (std::size_t i = 0; i < shown.size(); i += 2) {
      HistogramBin bin = shown[i];
      if (i + 1 < shown.size()) {
        bin.high = shown[i + 1].high;
        bin.count += shown[i + 1].count;
      }
      joined.push_back(bin);
    }
    shown = std::move(joined);
  }
  return shown;
}

std::string bin_name(const HistogramBin& bin) {
  if (bin.low == bin.high) return std::to_string(bin.low);
  if (bin.low < 10000) return fmt::format("{}–{}", bin.low, bin.high);
  return fmt::format("≥ {:.0e}", static_cast<double>(bin.low));
}

std::string histogram(const TargetResult& target) {
  const ImageDifference& difference = *target.difference;
  if (difference.identical || difference.format.type == ChannelType::uint32) return "";
  const std::vector<HistogramBin> bins = shown_bins(difference.histogram);
  if (bins.empty()) return "";
  double highest = 1;
  for (const HistogramBin& bin : bins) highest = std::max(highest, decibel(static_cast<double>(bin.count)) / 10 + 0.3);
  const double step = std::min(1000.0 / static_cast<double>(bins.size()), 120.0);
  std::string bars;
  for (std::size_t i = 0; i < bins.size(); ++i) {
    const double height = 62 * (decibel(static_cast<double>(bins[i].count)) / 10 + 0.3) / highest;
    const double x = static_cast<double>(i) * step;
    bars += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" rx=\"2\"><title>{}: {} samples</title></rect>",
                        x + 3, 82 - height, step - 6, height, bin_name(bins[i]), grouped(bins[i].count));
    bars += fmt::format(
        "<text x=\"{0:.1f}\" y=\"{1:.1f}\" text-anchor=\"middle\">{2}</text><text x=\"{0:.1f}\" y=\"97\" text-anchor=\"middle\">{3}</text>",
        x + step / 2, 77 - height, grouped(bins[i].count), bin_name(bins[i]));
  }
  const char* unit = is_float(difference.format.type) ? "units in the last place" : "stored units";
  return fmt::format(
      "<figure class=\"histogram wide\"><svg viewBox=\"0 0 1000 102\" role=\"img\" aria-label=\"Histogram of differences\"><line x1=\"0\" "
      "x2=\"1000\" y1=\"82.5\" y2=\"82.5\"/>{}</svg>"
      "<figcaption><span>Samples by size of their difference, in {}; logarithmic height.</span></figcaption></figure>",
      bars, unit);
}

std::string crop_figure(const Image& crop, const std::string& label) {
  return fmt::format(
      "<div class=\"crop\"><img width=\"85\" height=\"85\" alt=\"{0}, {1} by {1} texels\" src=\"{2}\"><span>{0}</span></div>", label,
      crop.width(), png_data_uri(crop));
}

std::string worst_texels(const CaseResult& item) {
  if (item.worst.empty()) return "";
  std::string cards;
  for (const WorstTexel& texel : item.worst) {
    cards += "<div class=\"texel\"><div class=\"crops\">" + crop_figure(texel.cpu_crop, item.sides.exact_short) +
             crop_figure(texel.gl_crop, item.sides.device_short) + "</div>";
    cards += fmt::format(
        "<div class=\"what\"><b class=\"mono\">({}, {})</b> &nbsp;{}<dl><dt>{}</dt><dd>{}</dd><dt>{}</dt><dd>{}</dd></dl></div><p "
        "class=\"why\">{}</p></div>",
        texel.x, texel.y, class_chip(texel.texel_class), escaped(item.sides.exact_short), escaped(texel.cpu_value),
        escaped(item.sides.device_short), escaped(texel.gl_value), escaped(texel.explanation));
  }
  const char* lead = item.tally.unexplained > 0 ? "unexplained ones first" : "none of them unexplained";
  return fmt::format("<details{}><summary>{} texels farthest from agreement, {}</summary><div class=\"worst\">{}</div></details>",
                     item.tally.unexplained > 0 ? " open" : "", item.worst.size(), lead, cards);
}

std::string panel(const CaseResult& item, const TargetResult& target, const std::string& id) {
  std::string html =
      fmt::format("<div role=\"tabpanel\" id=\"{0}\" aria-labelledby=\"{0}-tab\">", id) + comparison(item, target) + error_figure(target);
  if (target.difference) html += facts(target) + histogram(target);
  return html + "</div>";
}

}  // namespace

std::string class_chip(const std::string& texel_class) {
  return fmt::format("<span class=\"chip {0}\"><i class=\"swatch\"></i>{0}</span>", escaped(texel_class));
}

std::string share(std::uint64_t part, std::uint64_t all) {
  if (part == 0) return "0 %";
  if (part == all) return "100 %";
  const double percent = 100.0 * static_cast<double>(part) / static_cast<double>(all);
  if (percent < 0.0001) return "&lt; 0.0001 %";
  if (percent > 99.9999) return "&gt; 99.9999 %";
  return fmt::format("{:.4f} %", percent);
}

std::string case_article(const CaseResult& item, const std::string& id) {
  int picture_side = 1;
  for (const TargetResult& target : item.targets)
    picture_side = std::max({picture_side, target.cpu_picture.width(), target.cpu_picture.height()});
  const int step = (std::max(item.width, item.height) + picture_side - 1) / picture_side;
  std::string figures = fmt::format("{} × {}", item.width, item.height);
  if (item.triangles > 0) {
    figures += fmt::format(" · {} triangles · {} texels covered · CPU {:.2f} s · GL {:.2f} s", grouped(item.triangles),
                           grouped(item.covered), item.cpu_seconds, item.gl_seconds);
  }
  std::string html = fmt::format(
      "<article class=\"card\" id=\"{0}\" aria-labelledby=\"{0}-title\" data-step=\"{4}\" data-left=\"{5}\" data-right=\"{6}\"><div "
      "class=\"card-head\"><div><h3 "
      "id=\"{0}-title\">{1}</h3><p class=\"soft\">{2}</p></div>"
      "<p class=\"soft num\">{3}</p></div>",
      id, escaped(item.name()), escaped(item.description), figures, step, escaped(item.sides.exact), escaped(item.sides.device));
  if (!item.skipped.empty()) return html + "<div class=\"callout quiet\"><b>Skipped.</b> " + escaped(item.skipped) + "</div></article>";
  if (!item.diagnosis.empty()) html += "<div class=\"callout\"><b>Diagnosis.</b> " + escaped(item.diagnosis) + "</div>";
  html += fmt::format("<div class=\"tabs\" role=\"tablist\" aria-label=\"Targets of {}\">", escaped(item.name()));
  for (std::size_t i = 0; i < item.targets.size(); ++i) {
    html += fmt::format("<button role=\"tab\" type=\"button\" id=\"{0}-{1}-tab\" aria-controls=\"{0}-{1}\">{2}</button>", id, i,
                        content_title(item.targets[i].content));
  }
  html += "</div><div class=\"views\">";
  for (std::size_t i = 0; i < item.targets.size(); ++i) html += panel(item, item.targets[i], fmt::format("{}-{}", id, i));
  return html + class_figure(item) + "</div>" + worst_texels(item) + "</article>";
}

}  // namespace etalon::validation
