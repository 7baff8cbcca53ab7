#include "validation/studies/chen_study.h"

#include <doctest/doctest.h>

#include "core/adapt/map_format.h"

#include <cmath>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/mesh/weld.h"
#include "core/procedural/swirl.h"
#include "raster/cpu_renderer.h"
#include "validation/report/study_page.h"
#include "validation/studies/chen_report.h"
#include "validation/studies/normal_texture.h"

using namespace etalon;
using namespace etalon::validation;

namespace {

ChenSubject swirl_subject() {
  procedural::Model model = procedural::make_swirl({.faces = 512, .texture_size = 96});
  ChenSubject subject;
  subject.name = "swirl";
  subject.mesh = welded_by_position(model.mesh);
  subject.textures = {{"colour", std::move(model.texture), false}};
  subject.levels = {200, 80};
  subject.shows_parameterization = true, subject.paper_figure = 15;
  subject.inputs = {{.name = "swirl", .sha256 = std::string(64, '1'), .path = "", .role = "model", .attribution = ""}};
  return subject;
}

ChenStudyOptions small() {
  ChenStudyOptions options;
  options.map_size = 96, options.views_px = 64, options.view_count = 2, options.picture_px = 48;
  return options;
}

std::string text_of(const StudyReport& report) {
  auto document = study_document(report, {});
  document.erase("run");
  return document.dump();
}

}  // namespace

TEST_CASE("a whole study of a small swirl: every method, the same bytes for any number of threads") {
  raster::CpuRenderer exact;
  ChenStudyOptions options = small();
  int last = -1, total = 0;
  options.progress = [&](const std::string& label, int done, int all) {
    CHECK(!label.empty());
    CHECK(done >= last);
    CHECK(done < all);
    last = done, total = all;
  };
  std::string first;
  for (const int threads : {1, 3}) {
    set_thread_count(threads);
    last = -1;
    const ChenStudyResult result = run_chen_study({swirl_subject()}, exact, options);
    const StudyReport report = chen_report(result);
    if (first.empty()) first = text_of(report);
    CHECK(first == text_of(report));
    CHECK(last + 1 == total);
    if (threads != 1) continue;
    REQUIRE(result.subjects.size() == 1);
    const ChenSubjectResult& s = result.subjects.front();
    CHECK(s.outcomes.size() == 2 * kChenMethods.size());
    REQUIRE(s.levels.size() == 2);
    for (std::size_t l = 0; l < 2; ++l) {  // two faces go at a time, so that a level may be one below its name
      CHECK(s.levels[l] <= swirl_subject().levels[l]);
      CHECK(s.levels[l] + 1 >= swirl_subject().levels[l]);
    }
    CHECK(s.records.folded_cells == 0);
    CHECK(s.packing.same_bytes);
    CHECK(s.packing.printed_packs <= s.packing.packs);
    CHECK(s.packing.packs < s.packing.adaptations);
    // What the paper is about.
    for (std::size_t l = 0; l < 2; ++l) CHECK(*s.of(0, l, ChenMethod::indexed).masked_db > *s.of(0, l, ChenMethod::qem5).masked_db + 1);
    CHECK(*s.of(0, 0, ChenMethod::indexed).masked_db > *s.of(0, 1, ChenMethod::indexed).masked_db);
    REQUIRE(s.formats.size() == 4);
    CHECK(s.formats[0].format.errors.median <= s.formats[3].format.errors.median);  // float32 against unorm8
    CHECK(s.formats[3].format.unnamed == 0);                                        // 256 steps name 96 texels
    REQUIRE(s.inverses.size() == 3 * 4 * 2);
    for (const ChenInverse& i : s.inverses) {
      CHECK(i.down.median <= i.down.p99);
      CHECK(i.back.p99 <= i.back.largest);
      CHECK(i.unnamed == adapt::unnamed_texels(i.size, i.size, i.type));
    }
    const ChenInverse &coarse = s.inverses[0], &fine = s.inverses[16], &bytes = s.inverses[22];  // float32 and unorm8, linear
    CHECK(coarse.size * 8 == fine.size);
    CHECK(fine.back.median < 0.1);
    CHECK(bytes.type == ChannelType::unorm8);
    CHECK(bytes.back.median > fine.back.median);
    CHECK(!s.parameterization.empty());
    CHECK(!result.sharing.has_value());  // the swirl fills its map
    for (const StudyFigure& figure : report.figures) {
      CAPTURE(figure.id);
      CHECK((!figure.svg.empty() || !figure.pictures.empty()));
      for (const StudyPicture& picture : figure.pictures) CHECK(!picture.image.empty());
    }
  }
  set_thread_count(0);
}

TEST_CASE("study chen: what is refused") {
  raster::CpuRenderer exact;
  const auto refused = [&](const ChenSubject& subject, const char* words) {
    CHECK_THROWS_WITH_AS((void)run_chen_study({subject}, exact, small()), doctest::Contains(words), InputError);
  };
  ChenSubject subject = swirl_subject();
  subject.textures.clear();
  refused(subject, "swirl: expected a texture, got none");
  subject = swirl_subject();
  subject.levels = {80, 200};
  refused(subject, "expected descending numbers below 80 faces, got 200");
  subject.levels = {512};
  refused(subject, "below 512 faces, got 512");
  subject.levels.clear();
  refused(subject, "expected a level at least");
  subject = swirl_subject();
  subject.mesh.has_uv = false;
  refused(subject, "expected texture coordinates, got none");
  subject = swirl_subject();
  subject.mesh.wedges[7].uv.x = 3;
  refused(subject, "tiled");
}

TEST_CASE("figures 1 to 3: on a line and in a plane adaptation is exact but for float32") {
  const ChenLineExample line = line_example();
  CHECK(std::abs(line.c_after - line.c.x) < 0x1p-24);  // C's foot on AB
  raster::CpuRenderer renderer;
  const ChenPlaneExample plane = plane_example(renderer, 128);
  CHECK(plane.damped == 0);
  CHECK(plane.levels[0].mesh.face_count() == 8);
  CHECK(plane.levels[2].mesh.face_count() == 4);
  CHECK(plane.levels[0].farthest < 0x1p-40);  // no collapse: the same point, looked up twice
  for (const std::size_t i : {std::size_t{1}, std::size_t{2}}) {
    CHECK(plane.levels[i].farthest < 0x1p-20);
    CHECK(plane.levels[i].farthest > 0);
  }
}

TEST_CASE("several objects in one pass: each has what it has alone, but for the rounding of its coordinates") {
  procedural::Model model = procedural::make_swirl({.faces = 512, .texture_size = 64});
  for (Wedge& wedge : model.mesh.wedges) wedge.uv = {0.25f + 0.5f * wedge.uv.x, 0.25f + 0.5f * wedge.uv.y};  // off the map's edge
  simplify::SimplifyOptions options;
  options.metric = simplify::MetricName::qem5, options.target_faces = 100;
  progressive::ProgressiveMesh mesh(progressive::make_progressive(welded_by_position(model.mesh), options).data);
  const adapt::AdaptSequence sequence(mesh);
  CHECK(keeps_off_edges(sequence, 0.2));
  CHECK(!keeps_off_edges(sequence, 0.3));
  raster::CpuRenderer exact;
  const ChenSharing sharing = measure_sharing({"one", "other"}, {&sequence, &sequence}, exact, nullptr, 64);
  CHECK(sharing.passes == sharing.packs[0]);
  CHECK(sharing.texels == 2 * 64 * 64);
  // A coordinate in the upper half of the atlas has 24 bits below 1, half as many as it had: 2^-25 of the atlas, 2^-18 texels each time, and
  // there are fewer than 2^9 passes; lookups stretch that by less than 2^4 here.
  CHECK(sharing.largest < 0x1p-5);
}

TEST_CASE("pictures: exact sums over common texels, detail, averages") {
  const auto view = [](std::initializer_list<int> greys) {  // −1: empty
    DrawnView drawn{Image(static_cast<int>(greys.size()), 1, kRgba8), Image(static_cast<int>(greys.size()), 1, kR32ui)};
    int x = 0;
    for (const int grey : greys) {
      for (int k = 0; k < 3; ++k) drawn.color.channels<std::uint8_t>(x, 0)[k] = static_cast<std::uint8_t>(std::max(grey, 0));
      *drawn.id.channels<std::uint32_t>(x, 0) = grey < 0 ? kNoTriangle : 7;
      ++x;
    }
    return drawn;
  };
  PictureSums sums;
  sums.add(view({10, 20, 40, -1}), view({10, 22, 36, 5}));
  CHECK(sums.texels == 4);
  CHECK(sums.sse == 3 * (4 + 16 + 25));
  CHECK(sums.common_texels == 3);
  CHECK(sums.common_sse == 3 * (4 + 16));
  CHECK(sums.detail_a == 3 * (100 + 400));
  CHECK(sums.detail_b == 3 * (144 + 196));
  PictureSums same;
  same.add(view({10}), view({10}));
  CHECK(!same.masked_db().has_value());

  Image picture(2, 2, kRgb8);
  const std::uint8_t reds[] = {1, 2, 3, 4};
  for (int n = 0; n < 4; ++n) picture.channels<std::uint8_t>(n % 2, n / 2)[0] = reds[n];
  CHECK(averaged_down(picture, 2).channels<std::uint8_t>(0, 0)[0] == 3);  // 2.5, halves up
  CHECK(on_paper(view({-1, 9})).channels<std::uint8_t>(1, 0)[0] == 9);
  CHECK(on_paper(view({-1, 9})).channels<std::uint8_t>(0, 0)[0] == 236);
}

TEST_CASE("normals: of a square that faces +Z, plain and bent by a tangent map that leans toward +u") {
  Mesh mesh;
  mesh.has_uv = true;
  mesh.positions = {{0, 0, 0}, {0, 1, 0}, {-1, 1, 0}, {-1, 0, 0}};  // u runs along +y, v along −x
  const Vec2f uv[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (std::uint32_t v = 0; v < 4; ++v) mesh.wedges.push_back({VertexId(v), uv[v]});
  mesh.faces = {{WedgeId(0u), WedgeId(1u), WedgeId(2u)}, {WedgeId(0u), WedgeId(2u), WedgeId(3u)}};
  raster::CpuRenderer renderer;
  const auto texel = [](const Image& image) {
    const auto* const c = image.channels<std::uint8_t>(3, 3);
    return std::array<int, 3>{c[0], c[1], c[2]};
  };
  CHECK(texel(object_normals(renderer, mesh, nullptr, 8)) == std::array<int, 3>{128, 128, 255});
  Image tangent(8, 8, kRgb8);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      tangent.channels<std::uint8_t>(x, y)[0] = 255, tangent.channels<std::uint8_t>(x, y)[1] = 127,
                                        tangent.channels<std::uint8_t>(x, y)[2] = 127;
  const auto bent = texel(object_normals(renderer, mesh, &tangent, 0));
  CHECK(bent[1] == 255);  // along +y, where u runs
  CHECK(std::abs(bent[2] - 127) <= 1);
  const Image no_colors(8, 8, kR32f);
  CHECK_THROWS_WITH_AS((void)object_normals(renderer, mesh, &no_colors, 0), doctest::Contains("normal map: expected RGB or RGBA unorm8"),
                       InputError);
  Image drawn(1, 1, kRgba8);
  auto* const c = drawn.channels<std::uint8_t>(0, 0);
  c[0] = 128, c[1] = 128, c[2] = 255, c[3] = 255;
  CHECK(lit_by_normals(drawn, {0, 0, 1}).channels<std::uint8_t>(0, 0)[0] > 220);
  CHECK(lit_by_normals(drawn, {0, 0, -1}).channels<std::uint8_t>(0, 0)[0] < 80);
}
