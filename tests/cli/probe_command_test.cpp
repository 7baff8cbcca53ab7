// etalon probe on Mesa's two rasterizers, each in a process of its own, against what was measured of them apart; then diff by what it wrote.
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "core/io/image_file.h"
#include "tests/cli/run_command.h"
#include "tests/cli/schema_validator.h"
#include "tests/support/skip.h"

using namespace etalon;
using namespace etalon::test;
using nlohmann::json;

namespace {

// Null, after a reported skip, where there is no such device.
json probe(const ScratchFolder& folder, const std::string& context, const std::string& driver, const std::string& output) {
  const CommandResult result = run_etalon({"probe", "--context", context, "--driver", driver, "-o", output}, {.folder = folder.path()});
  if (result.exit_code == 1) {
    report_skip("probe of " + driver + " by " + context, result.err);
    return nullptr;
  }
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  const json document = json::parse(read_text(folder.path() / output));
  const json schema = json::parse(read_text(std::string(ETALON_SCHEMAS) + "/probe.json"));
  for (const std::string& violation : schema_violations(schema, document)) FAIL_CHECK(violation);
  return document;
}

void check_llvmpipe(const json& found) {
  CHECK(found["device"]["declared_subtexel_bits"] == 8);
  CHECK(found["coverage"]["subtexel_bits"] == 8);
  CHECK(found["coverage"]["snap"] == "nearest_even");
  CHECK(found["coverage"]["fill_rule"] == "left_ymin");
  CHECK(found["coverage"]["differing"] == 0);
  // The derived bound holds, and is not a hundred times too large.
  for (const char* kind : {"affine", "perspective", "depth"}) {
    CHECK(found["interpolation"][kind].get<double>() < 1);
    CHECK(found["interpolation"][kind].get<double>() > 0.01);
  }
  CHECK(found["nearest"]["earliest_texel"] == 0);
  CHECK(found["nearest"]["latest_texel"] == 0);
  CHECK(found["linear"]["unorm8"]["weight_bits"] == 8);
  CHECK(found["linear"]["unorm8"]["levels_of_small_step"] == 2);
  CHECK(found["linear"]["unorm8"]["largest_value_error"].get<double>() < 2.0 / 255);
  CHECK(found["linear"]["float32"]["weight_bits"].is_null());
  CHECK(found["linear"]["float32"]["largest_value_error"].get<double>() < 2.2e-7);
  CHECK(found["storage"]["half"] == "toward_zero");
  CHECK(found["storage"]["unorm8_nearest"] == true);
}

void write_drawings(const ScratchFolder& folder) {
  folder.file("square.obj", square_obj());
  REQUIRE(run_etalon(
              {"render", "square.obj", "--size", "200", "--view", "9/24", "--margins", "--write-draws", "golden.draws", "-o", "golden.exr"},
              {.folder = folder.path()})
              .exit_code == 0);
  REQUIRE(
      run_etalon({"render", "golden.draws", "--backend", "gl", "--driver", "llvmpipe", "-o", "candidate.png"}, {.folder = folder.path()})
          .exit_code == 0);
}

}  // namespace

TEST_CASE("probe: llvmpipe is what it was measured to be, the same by OSMesa and by EGL") {
  const ScratchFolder folder;
  json osmesa = probe(folder, "osmesa", "llvmpipe", "osmesa.json"), egl = probe(folder, "egl", "llvmpipe", "egl.json");
  for (json* document : {&osmesa, &egl}) {
    if (document->is_null()) continue;
    check_llvmpipe(*document);
    document->erase("run");
    (*document)["device"].erase("origin");
  }
  if (!osmesa.is_null() && !egl.is_null()) CHECK(osmesa == egl);
}

TEST_CASE("probe: softpipe covers by no rule, and filters in floats") {
  const ScratchFolder folder;
  const json found = probe(folder, "osmesa", "softpipe", "softpipe.json");
  if (found.is_null()) return;
  CHECK(found["coverage"]["fill_rule"].is_null());
  CHECK(found["coverage"]["differing"].get<int>() > 0);
  CHECK(found["linear"]["unorm8"]["weight_bits"].is_null());
  CHECK(found["linear"]["unorm8"]["largest_value_error"].get<double>() < 2.2e-6);
  CHECK(found["storage"]["half"] == "toward_zero");
}

TEST_CASE("diff --device PROBE.json: classes on bounds that were measured, and said to be") {
  const ScratchFolder folder;
  if (probe(folder, "auto", "llvmpipe", "device.json").is_null()) return;
  write_drawings(folder);
  const CommandResult agreed =
      run_etalon({"diff", "golden.exr", "candidate.png", "--device", "device.json", "--json", "d.json"}, {.folder = folder.path()});
  CHECK(agreed.exit_code == 0);
  CHECK(agreed.out.find("unexplained 0") != std::string::npos);
  CHECK(agreed.out.find("times 4 (rests on a measured bound: no proof)") != std::string::npos);
  const json document = json::parse(read_text(folder.path() / "d.json"));
  CHECK(schema_violations(json::parse(read_text(std::string(ETALON_SCHEMAS) + "/diff.json")), document).empty());
  CHECK(document["jobs"][0]["device"]["origin"] == "measured");
  CHECK(document["jobs"][0]["device"]["proven"] == false);
  CHECK(document["inputs"][3]["role"] == "device");

  Image wrong = io::read_image(folder.path() / "candidate.png");
  wrong.channels<std::uint8_t>(100, 100)[0] ^= 0x20;
  io::write_image(folder.path() / "wrong.png", wrong);
  CHECK(run_etalon({"diff", "golden.exr", "wrong.png", "--device", "device.json"}, {.folder = folder.path()}).exit_code == 2);

  const auto changed = [&](const char* member, const json& value) {
    json other = json::parse(read_text(folder.path() / "device.json"));
    other["coverage"][member] = value;
    folder.file("other.json", other.dump());
  };
  changed("fill_rule", "left_ymax");
  check_refused({"diff", "golden.exr", "candidate.png", "--device", "other.json"}, 4, folder, "fills edges by left_ymax");
  changed("subtexel_bits", 4);
  check_refused({"diff", "golden.exr", "candidate.png", "--device", "other.json"}, 4, folder, "draw the golden with --snap-bits 4");
  changed("fill_rule", nullptr);
  CHECK(run_etalon({"diff", "golden.exr", "candidate.png", "--device", "other.json"}, {.folder = folder.path()})
            .out.find("covers texels by no one fill rule") != std::string::npos);
}

TEST_CASE("probe, and diff by a probe: what the command line cannot mean") {
  const ScratchFolder folder;
  folder.file("bad.json", "{\"schema\": \"etalon/probe/1\"");
  folder.file("a.png", "x");
  check_refused({"probe"}, 64, folder, "output");
  check_refused({"probe", "--shader", "exact", "-o", "p.json"}, 64, folder, "--shader exact");
  check_refused({"probe", "-o", "none/p.json"}, 4, folder, "none");
  check_refused({"diff", "a.png", "a.png", "--device", "none.json"}, 4, folder, "none.json");
  check_refused({"diff", "a.png", "a.png", "--device", "bad.json"}, 4, folder, "expected a JSON document of etalon probe");
  check_refused({"diff", "a.png", "a.png", "--device", "bad.json", "--json", "bad.json"}, 64, folder, "bad.json");
}
