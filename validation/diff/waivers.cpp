#include "validation/diff/waivers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/io/inputs.h"

namespace etalon::validation {
namespace {

using Json = nlohmann::json;

[[noreturn]] void refuse(const std::string& file, const std::string& what) { throw InputError(file + ": " + what); }

int number_at(const std::string& text, std::size_t at, std::size_t count) {
  int value = -1;
  std::from_chars(text.data() + at, text.data() + at + count, value);
  return value;
}

bool is_day(const std::string& text) {
  const bool shape = text.size() == 10 && text[4] == '-' && text[7] == '-' && text.find_first_not_of("0123456789-") == std::string::npos;
  if (!shape) return false;
  return std::chrono::year_month_day(std::chrono::year(number_at(text, 0, 4)),
                                     std::chrono::month(static_cast<unsigned>(number_at(text, 5, 2))),
                                     std::chrono::day(static_cast<unsigned>(number_at(text, 8, 2))))
      .ok();
}

std::string text_of(const Json& item, const std::string& file, const std::string& path, const char* key) {
  if (!item.contains(key) || !item[key].is_string() || item[key].get<std::string>().empty())
    refuse(file, fmt::format("{}.{}: expected a text", path, key));
  return item[key].get<std::string>();
}

Waiver waiver_of(const Json& item, const std::string& file, std::size_t n) {
  const std::string path = fmt::format("waivers[{}]", n);
  if (!item.is_object()) refuse(file, path + ": expected an object");
  constexpr std::array kKeys{"pair", "device", "reason", "expires", "texels"};
  for (const auto& member : item.items()) {
    const std::string& key = member.key();
    if (std::none_of(kKeys.begin(), kKeys.end(), [&](const char* known) { return key == known; }))
      refuse(file, fmt::format("{}: expected pair, device, reason, expires and texels, got a member '{}'", path, key));
  }
  Waiver waiver{text_of(item, file, path, "pair"), text_of(item, file, path, "device"), text_of(item, file, path, "reason"),
                text_of(item, file, path, "expires"), 0};
  if (!is_day(waiver.expires)) refuse(file, fmt::format("{}.expires: expected a day as 2027-01-31, got '{}'", path, waiver.expires));
  if (!item.contains("texels") || !item["texels"].is_number_unsigned() || item["texels"] == 0)
    refuse(file, path + ".texels: expected the number of unexplained texels, 1 or more");
  waiver.texels = item["texels"].get<std::uint64_t>();
  return waiver;
}

}  // namespace

std::vector<Waiver> read_waivers(const std::string& path) {
  const io::FileBytes bytes = io::read_file(path);
  const Json document = Json::parse(bytes.text().begin(), bytes.text().end(), nullptr, false);
  // Not document.value(): it would copy whatever stands there, by recursion.
  const bool is_ours =
      document.is_object() && document.contains("schema") && document["schema"].is_string() && document["schema"] == "etalon/waivers/1";
  if (!is_ours) refuse(path, "expected a JSON object with the schema 'etalon/waivers/1'");
  if (!document.contains("waivers") || !document["waivers"].is_array()) refuse(path, "waivers: expected an array");
  std::vector<Waiver> waivers;
  for (const Json& item : document["waivers"]) waivers.push_back(waiver_of(item, path, waivers.size()));
  return waivers;
}

std::vector<std::string> apply_waivers(std::vector<PairResult>& pairs, const std::vector<Waiver>& waivers, const std::string& device,
                                       const std::string& today) {
  std::vector<std::string> unused;
  for (const Waiver& waiver : waivers) {
    if (waiver.device != device) continue;
    if (waiver.expires < today) {
      unused.push_back(fmt::format("waiver of {}: expired on {} ({})", waiver.pair, waiver.expires, waiver.reason));
      continue;
    }
    bool used = false;
    for (PairResult& pair : pairs) {
      const bool fails = pair.status == PairStatus::compared && pair.verdict == PairVerdict::failure;
      if (pair.name != waiver.pair || !fails || pair.page.tally.unexplained > waiver.texels) continue;
      used = true;
      pair.verdict = pair.unproven_ties > 0 ? PairVerdict::warning : PairVerdict::pass;  // a waiver proves no tie
      pair.note = fmt::format("waived until {}: {}", waiver.expires, waiver.reason);
    }
    if (!used)
      unused.push_back(fmt::format("waiver of {}: covers nothing: no such pair, no failure, or more than {} unexplained texels ({})",
                                   waiver.pair, waiver.texels, waiver.reason));
  }
  return unused;
}

std::string today_utc() {
  const std::chrono::year_month_day day(std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now()));
  return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(day.year()), static_cast<unsigned>(day.month()),
                     static_cast<unsigned>(day.day()));
}

}  // namespace etalon::validation
