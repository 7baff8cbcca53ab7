// A small verification with everything in it that a report shows.
#pragma once

#include "validation/verify/verify_result.h"

namespace etalon::test {

inline validation::VerifyResult sample_result() {
  using namespace etalon::validation;
  Image a(4, 4, kRgb8);
  Image b = a;
  b.channels<std::uint8_t>(1, 2)[0] = 3;
  TargetResult target;
  target.content = "color";
  target.format = "rgb unorm8";
  target.difference = measure_difference(a, b);
  target.cpu_sha256 = a.sha256();
  target.gl_sha256 = b.sha256();
  target.cpu_picture = a;
  target.gl_picture = b;
  target.error_picture = b;
  CaseResult item;
  item.job = "render";
  item.model = "a <b> & \"c\", d";
  item.view = "fit";
  item.sampling = "nearest";
  item.width = item.height = 4;
  item.triangles = 1234;
  item.covered = 7;
  item.tally = {.texels = 16, .identical = 15, .rounding = 0, .tie = 1, .unbounded = 0, .unexplained = 0};
  item.class_picture = a;
  WorstTexel worst;
  worst.x = 1;
  worst.y = 2;
  worst.texel_class = "tie";
  worst.cpu_value = "color 0 0 0";
  worst.gl_value = "color 3 0 0";
  worst.explanation = "Because </script><script>alert(1)</script>.";
  worst.cpu_crop = worst.gl_crop = Image(kCropSize, kCropSize, kRgb8);
  item.worst = {worst};
  item.targets = {target};
  VerifyResult result;
  result.inputs = {{.name = "head.glb",
                    .sha256 = std::string(64, 'a'),
                    .path = "/secret/place/head.glb",
                    .role = "model",
                    .attribution = "Somebody, CC BY 3.0"}};
  result.jobs = {{"render", "", {item}}, {"indexed", "no texture coordinates (try another)", {}}};
  result.cpu_name = "exact";
  result.gl_name = "some device";
  result.bounds_origin = "derived: here";
  return result;
}

}  // namespace etalon::test
