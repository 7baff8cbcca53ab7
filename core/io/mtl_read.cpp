// Material libraries of OBJ: only the colour texture (map_Kd) concerns us. Lenient, as material libraries in the wild are.
#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>

#include "core/io/mesh_formats.h"
#include "core/io/text_scan.h"

namespace etalon::io {
namespace {

namespace fs = std::filesystem;

struct TextureOption {
  std::string_view name;
  int fewest;  // arguments that always follow
  int most;    // of these, numbers only
};
constexpr std::array<TextureOption, 13> kOptions = {{{"-blendu", 1, 1},
                                                     {"-blendv", 1, 1},
                                                     {"-cc", 1, 1},
                                                     {"-clamp", 1, 1},
                                                     {"-mm", 2, 2},
                                                     {"-o", 1, 3},
                                                     {"-s", 1, 3},
                                                     {"-t", 1, 3},
                                                     {"-texres", 1, 1},
                                                     {"-bm", 1, 1},
                                                     {"-boost", 1, 1},
                                                     {"-imfchan", 1, 1},
                                                     {"-type", 1, 1}}};

/// The file name of a texture statement: what is left after the options; it may hold spaces.
std::string_view texture_name(std::string_view rest) {
  while (true) {
    rest = trimmed(rest);
    std::string_view after = rest;
    const std::string_view word = take_word(after);
    const auto option = std::find_if(kOptions.begin(), kOptions.end(), [&](const TextureOption& o) { return o.name == word; });
    if (option == kOptions.end()) return rest;
    for (int i = 0; i < option->most; ++i) {
      std::string_view next = after;
      const std::string_view argument = take_word(next);
      if (i >= option->fewest && !parse_float(argument)) break;
      after = next;
    }
    rest = after;
  }
}

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

}  // namespace

std::map<std::string, fs::path> read_mtl(const fs::path& path) {
  std::map<std::string, fs::path> result;
  std::error_code error;
  if (fs::file_size(path, error) == 0 || error) return result;
  const FileBytes content = read_file(path);
  std::string_view text = content.text();
  std::string current;
  bool named = false;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view rest = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::string_view keyword = take_word(rest);
    if (keyword == "newmtl") {
      current = trimmed(rest);
      named = true;
      result.try_emplace(current);
    } else if (keyword == "map_Kd" && named && result[current].empty()) {
      result[current] = fs::path(texture_name(rest));
    }
  }
  return result;
}

fs::path find_beside(const fs::path& folder, std::string_view name) {
  name = trimmed(name);
  if (name.size() >= 2 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
  if (name.empty() || name.find('\0') != name.npos) return {};
  std::string slashes(name);
  std::replace(slashes.begin(), slashes.end(), '\\', '/');
  for (const fs::path& candidate : {folder / fs::path(name), folder / fs::path(slashes), folder / fs::path(slashes).filename()})
    if (is_file(candidate)) return candidate;
  return {};
}

}  // namespace etalon::io
