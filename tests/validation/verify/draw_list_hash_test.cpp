#include "validation/verify/draw_list_hash.h"

#include <functional>

#include <doctest/doctest.h>

using namespace etalon;
using namespace etalon::validation;

TEST_CASE("every field of a draw list counts, its faces' origin does not") {
  DrawList list;
  list.vertices.resize(3);
  list.triangles = {{0, 1, 2}};
  list.draws.resize(1);
  list.draws[0].triangle_count = 1;
  list.images = {std::make_shared<const Image>(1, 1, kRgb8)};
  const std::string original = draw_list_sha256(list);
  const std::vector<std::function<void(DrawList&)>> changes{[](DrawList& l) { l.vertices[2].x = -1; },
                                                            [](DrawList& l) { l.vertices[1].y = 1; },
                                                            [](DrawList& l) { l.vertices[0].z = 0.5f; },
                                                            [](DrawList& l) { l.vertices[0].w = 2; },
                                                            [](DrawList& l) { l.vertices[0].uv.x = 1; },
                                                            [](DrawList& l) { l.vertices[0].uv.y = 1; },
                                                            [](DrawList& l) { l.vertices[0].color.w = 0; },
                                                            [](DrawList& l) {
                                                              l.triangles[0] = {0, 2, 1};
                                                            },
                                                            [](DrawList& l) { l.draws[0].first_triangle = 1; },
                                                            [](DrawList& l) { l.draws[0].shading = Shading::indexed; },
                                                            [](DrawList& l) { l.draws[0].texture = 0; },
                                                            [](DrawList& l) { l.draws[0].sampler.filter = Filter::linear; },
                                                            [](DrawList& l) { l.draws[0].map_sampler.wrap_v = Wrap::repeat; },
                                                            [](DrawList& l) { l.draws[0].indexing_map = 0; },
                                                            [](DrawList& l) { l.images[0] = std::make_shared<const Image>(2, 1, kRgb8); }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    DrawList changed = list;
    changes[i](changed);
    CAPTURE(i);
    CHECK(draw_list_sha256(changed) != original);
  }
  DrawList same = list;
  same.source_faces = {7};
  CHECK(draw_list_sha256(same) == original);
}
