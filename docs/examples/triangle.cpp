// Draws one triangle on the exact rasterizer: the same sha256 on every machine.
#include <cstdio>

#include "raster/cpu_renderer.h"

int main() {
  etalon::DrawList list;
  list.vertices = {{.x = 512, .y = 512, .color = {1, 0, 0, 1}},     // in 1/256 texel: texel (2, 2)
                   {.x = 15872, .y = 1024, .color = {0, 1, 0, 1}},  // texel (62, 4)
                   {.x = 8192, .y = 15872, .color = {0, 0, 1, 1}}};
  list.triangles = {{0, 1, 2}};
  list.draws = {{.triangle_count = 1}};
  etalon::raster::CpuRenderer renderer;
  const std::vector<etalon::Image> images = renderer.render(list, {.width = 64, .height = 64, .targets = {{}}});
  std::printf("%s\n", images[0].sha256().c_str());
}
