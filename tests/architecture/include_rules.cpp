#include "tests/architecture/include_rules.h"

#include <algorithm>
#include <map>
#include <set>

namespace etalon::test {
namespace {

// Layer → what it may include directly; the closure is allowed too. "*" is everything but tests.
const std::map<std::string, std::vector<std::string>> kArrows = {
    {"core/base", {}},
    {"core/math", {"core/base"}},
    {"core/image", {"core/math"}},
    {"core/mesh", {"core/math"}},
    {"core/draw", {"core/image", "core/mesh"}},
    {"core/simplify", {"core/mesh"}},
    {"core/progressive", {"core/simplify"}},
    {"core/adapt", {"core/progressive", "core/draw"}},
    {"core/bake", {"core/simplify", "core/image"}},
    {"core/terrain", {"core/mesh", "core/image"}},
    {"core/wavelet", {"core/image"}},
    {"core/joint", {"core/terrain", "core/wavelet"}},
    {"core/io", {"core/draw", "core/progressive"}},
    {"core/procedural", {"core/mesh", "core/image"}},
    {"raster", {"core/draw"}},
    {"gpu", {"core/draw"}},
    {"validation", {"*"}},
    {"cli", {"*"}},
    {"tests", {"*", "tests"}},
    {"docs/examples", {"*"}},
};

// The judge sees data only, and no arithmetic of core/math.
const std::vector<std::string> kReferenceMayInclude = {"validation/reference", "core/base", "core/image", "core/draw"};
// Plain types that the headers of core/image and core/draw are written in; none of them computes.
const std::set<std::string> kReferenceMayReach = {"core/math/vec.h", "core/mesh/mesh.h"};

struct OutsideLibrary {
  std::string name;
  std::vector<std::string> prefixes;  ///< of the include's target
  std::vector<std::string> folders;   ///< where it may be included
};

const std::vector<OutsideLibrary> kOutsideLibraries = {
    {"TBB", {"tbb/", "oneapi/"}, {"core/base"}},
    {"OpenImageIO", {"OpenImageIO/"}, {"core/io", "tests/io"}},
    {"OpenEXR and Imath", {"OpenEXR/", "Imath/", "Imf", "Imath", "half.h"}, {"core/io", "tests/io"}},
    {"a mesh parser", {"tiny_obj_loader.h", "tiny_gltf.h", "assimp/"}, {"core/io", "tests/io"}},
    {"OpenGL and the dynamic loader", {"GL/", "GLES", "EGL/", "KHR/", "dlfcn.h"}, {"gpu", "tests/gpu"}},
    {"Highway", {"hwy/"}, {"raster"}},
    {"Boost", {"boost/"}, {"validation/reference", "tests"}},
    {"CLI11", {"CLI/"}, {"cli"}},
    {"doctest", {"doctest/"}, {"tests"}},
    {"Google Benchmark", {"benchmark/"}, {"tests/bench"}},
    {"GLM", {"glm/"}, {"core/math"}},
};

const std::set<std::string>& allowed_layers(const std::string& layer) {
  static std::map<std::string, std::set<std::string>> closures;
  auto [entry, is_new] = closures.try_emplace(layer);
  if (!is_new) return entry->second;
  std::set<std::string> reached = {layer};
  for (const std::string& next : kArrows.at(layer)) {
    if (next == "*") {
      for (const auto& [name, arrows] : kArrows)
        if (name != "tests" && name != "cli" && name != "docs/examples") reached.insert(name);
      if (layer == "tests") reached.insert("cli");
    } else {
      reached.insert(next);
      if (next != layer) reached.insert(allowed_layers(next).begin(), allowed_layers(next).end());
    }
  }
  return closures[layer] = reached;
}

bool under_any(const std::string& path, const std::vector<std::string>& folders) {
  return std::ranges::any_of(folders, [&](const std::string& folder) { return is_under(path, folder); });
}

void check_ours(const SourceFile& file, const Include& include, const std::set<std::string>& paths, std::vector<Violation>& out) {
  const std::string from = layer_of(file.path), to = layer_of(include.target);
  const auto report = [&](const char* rule, const std::string& detail) { out.push_back({file.path, include.line, rule, detail}); };
  if (!paths.contains(include.target))
    return report("include path", "\"" + include.target + "\" is no file of the tree, written from its root");
  if (to.empty()) return report("layer", include.target + " is in a folder that no rule knows");
  if (is_under(file.path, "validation/reference") && !under_any(include.target, kReferenceMayInclude))
    return report("layer", "validation/reference must not include " + include.target);
  if (!allowed_layers(from).contains(to)) report("layer", from + " must not include " + to + " (" + include.target + ")");
}

void check_outside(const SourceFile& file, const Include& include, std::vector<Violation>& out) {
  if (!layer_of(include.target).empty() || is_under(include.target, "core"))
    out.push_back({file.path, include.line, "include path", "<" + include.target + ">: our own headers are included with quotes"});
  for (const OutsideLibrary& library : kOutsideLibraries) {
    const bool is_it = std::ranges::any_of(library.prefixes, [&](const std::string& prefix) { return include.target.starts_with(prefix); });
    if (is_it && !under_any(file.path, library.folders))
      out.push_back({file.path, include.line, "outside library",
                     library.name + " (<" + include.target + ">) belongs in " + library.folders.front() + " only"});
  }
}

}  // namespace

std::string layer_of(const std::string& path) {
  for (const auto& [layer, arrows] : kArrows)
    if (is_under(path, layer) && path != layer) return layer;
  return "";
}

std::vector<Violation> check_includes(const std::vector<SourceFile>& files) {
  std::vector<Violation> violations;
  std::set<std::string> paths;
  for (const SourceFile& file : files) paths.insert(file.path);
  for (const SourceFile& file : files) {
    if (layer_of(file.path).empty()) {
      violations.push_back({file.path, 0, "layer", "in a folder that no rule knows"});
      continue;
    }
    for (const Include& include : includes_of(file.text)) {
      if (include.quoted)
        check_ours(file, include, paths, violations);
      else
        check_outside(file, include, violations);
    }
  }
  return violations;
}

std::vector<Violation> check_reference_reach(const std::vector<SourceFile>& files) {
  std::map<std::string, const SourceFile*> by_path;
  for (const SourceFile& file : files) by_path[file.path] = &file;
  std::vector<Violation> violations;
  for (const SourceFile& start : files) {
    if (!is_under(start.path, "validation/reference")) continue;
    std::map<std::string, std::string> chain = {{start.path, start.path}};
    std::vector<std::string> open = {start.path};
    while (!open.empty()) {
      const std::string path = open.back();
      open.pop_back();
      if (!under_any(path, kReferenceMayInclude) && !kReferenceMayReach.contains(path))
        violations.push_back({start.path, 0, "the judge's reach", chain[path]});
      if (!by_path.contains(path)) continue;
      for (const Include& include : includes_of(by_path[path]->text))
        if (include.quoted && chain.try_emplace(include.target, chain[path] + " -> " + include.target).second)
          open.push_back(include.target);
    }
  }
  return violations;
}

}  // namespace etalon::test
