// Planted violations: the layer checker sees each, and lets the legal neighbour pass.
#include "tests/architecture/include_rules.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

using namespace etalon::test;

namespace {

// A small legal tree, to which a test adds one file.
std::vector<SourceFile> tree_with(const std::string& path, const std::string& text) {
  std::vector<SourceFile> files = {{"core/base/error.h", ""},     {"core/math/vec.h", ""},
                                   {"core/math/wide_int.h", ""},  {"core/image/image.h", "#include \"core/math/vec.h\"\n"},
                                   {"core/mesh/mesh.h", ""},      {"core/simplify/q.h", ""},
                                   {"core/io/png.h", ""},         {"core/draw/state.h", "#include \"core/image/image.h\"\n"},
                                   {"raster/cpu_renderer.h", ""}, {"gpu/gl_renderer.h", ""},
                                   {"validation/diff.h", ""},     {"validation/reference/judge.h", ""},
                                   {"tests/support/skip.h", ""},  {"cli/verify.h", ""}};
  files.push_back({path, text});
  return files;
}

std::vector<std::string> found(const std::string& path, const std::string& text) {
  std::vector<std::string> rules;
  for (const Violation& violation : check_includes(tree_with(path, text))) rules.push_back(violation.rule);
  return rules;
}

const std::vector<std::string> kClean = {};
const std::vector<std::string> kLayer = {"layer"};
const std::vector<std::string> kPath = {"include path"};
const std::vector<std::string> kLibrary = {"outside library"};

}  // namespace

TEST_CASE("layers: the small tree is clean") { CHECK(found("core/base/a.h", "") == kClean); }

TEST_CASE("layers: arrows point down, through any number of steps") {
  CHECK(found("core/draw/a.h", "#include \"core/mesh/mesh.h\"\n") == kClean);
  CHECK(found("core/draw/a.h", "#include \"core/base/error.h\"\n") == kClean);
  CHECK(found("core/adapt/a.h", "#include \"core/simplify/q.h\"\n#include \"core/image/image.h\"\n") == kClean);
  CHECK(found("core/base/a.h", "#include \"core/math/vec.h\"\n") == kLayer);
  CHECK(found("core/mesh/a.h", "#include \"core/image/image.h\"\n") == kLayer);
  CHECK(found("core/image/a.h", "#include \"core/mesh/mesh.h\"\n") == kLayer);
  CHECK(found("core/draw/a.cpp", "#include \"core/io/png.h\"\n") == kLayer);
  CHECK(found("core/simplify/a.h", "#include \"core/draw/state.h\"\n") == kLayer);
}

TEST_CASE("layers: the renderers see core/draw, nothing above it and not each other") {
  CHECK(found("raster/a.cpp", "#include \"core/draw/state.h\"\n#include \"core/math/wide_int.h\"\n") == kClean);
  CHECK(found("raster/a.cpp", "#include \"gpu/gl_renderer.h\"\n") == kLayer);
  CHECK(found("gpu/a.cpp", "#include \"raster/cpu_renderer.h\"\n") == kLayer);
  CHECK(found("gpu/a.cpp", "#include \"core/simplify/q.h\"\n") == kLayer);
  CHECK(found("core/draw/a.cpp", "#include \"raster/cpu_renderer.h\"\n") == kLayer);
}

TEST_CASE("layers: validation sees all below it; only tests see the tests and the commands") {
  CHECK(found("validation/a.cpp", "#include \"raster/cpu_renderer.h\"\n#include \"gpu/gl_renderer.h\"\n#include \"core/io/png.h\"\n") ==
        kClean);
  CHECK(found("validation/a.cpp", "#include \"cli/verify.h\"\n") == kLayer);
  CHECK(found("cli/a.cpp", "#include \"validation/diff.h\"\n") == kClean);
  CHECK(found("cli/a.cpp", "#include \"tests/support/skip.h\"\n") == kLayer);
  CHECK(found("tests/mesh/a_test.cpp", "#include \"tests/support/skip.h\"\n#include \"cli/verify.h\"\n") == kClean);
}

TEST_CASE("layers: a folder that no rule knows is refused") {
  CHECK(found("core/surprise/a.h", "") == kLayer);
  CHECK(found("tools/a.h", "") == kLayer);
}

TEST_CASE("include paths: from the root, and there") {
  CHECK(found("core/mesh/a.cpp", "#include \"mesh.h\"\n") == kPath);
  CHECK(found("core/mesh/a.cpp", "#include \"../mesh/mesh.h\"\n") == kPath);
  CHECK(found("core/mesh/a.cpp", "#include <core/mesh/mesh.h>\n") == kPath);
  CHECK(found("core/mesh/a.cpp", "#include <vector>\n") == kClean);
}

TEST_CASE("outside libraries: each in its folder") {
  CHECK(found("core/base/a.cpp", "#include <tbb/parallel_for.h>\n") == kClean);
  CHECK(found("raster/a.cpp", "#include <tbb/parallel_for.h>\n") == kLibrary);
  CHECK(found("core/io/a.cpp", "#include <OpenImageIO/imageio.h>\n#include <OpenEXR/ImfChannelList.h>\n#include <tiny_gltf.h>\n") ==
        kClean);
  CHECK(found("core/image/a.cpp", "#include <OpenImageIO/imageio.h>\n") == kLibrary);
  CHECK(found("raster/a.cpp", "#include <Imath/half.h>\n") == kLibrary);
  CHECK(found("core/mesh/a.cpp", "#include <tiny_obj_loader.h>\n") == kLibrary);
  CHECK(found("validation/reference/a.cpp", "#include <boost/multiprecision/cpp_int.hpp>\n") == kClean);
  CHECK(found("raster/a.cpp", "#include <boost/multiprecision/cpp_int.hpp>\n") == kLibrary);
  CHECK(found("validation/a.cpp", "#include <GL/gl.h>\n") == kLibrary);
  CHECK(found("core/base/a.cpp", "#include <doctest/doctest.h>\n") == kLibrary);
}

TEST_CASE("the judge: includes data, and reaches no arithmetic of ours") {
  CHECK(found("validation/reference/a.cpp", "#include \"core/draw/state.h\"\n#include \"core/image/image.h\"\n") == kClean);
  CHECK(found("validation/reference/a.cpp", "#include \"core/math/wide_int.h\"\n") == kLayer);
  CHECK(found("validation/reference/a.cpp", "#include \"raster/cpu_renderer.h\"\n") == kLayer);
  CHECK(found("validation/reference/a.cpp", "#include \"validation/diff.h\"\n") == kLayer);

  const auto reach = [](const std::string& state_text) {
    std::vector<SourceFile> files = {{"core/math/vec.h", ""}, {"core/math/wide_int.h", ""}, {"core/draw/list.h", state_text}};
    files.push_back({"validation/reference/judge.cpp", "#include \"core/draw/list.h\"\n"});
    return check_reference_reach(files);
  };
  CHECK(reach("#include \"core/math/vec.h\"\n").empty());
  const auto violations = reach("#include \"core/math/wide_int.h\"\n");
  REQUIRE(violations.size() == 1);
  CHECK(violations[0].detail == "validation/reference/judge.cpp -> core/draw/list.h -> core/math/wide_int.h");
}
