#include "validation/report/view_document.h"

#include "validation/report/json_report.h"

namespace etalon::validation {

std::string view_document(const Camera& camera, int width, int height) {
  const auto vector = [](const Vec3d& v) { return nlohmann::ordered_json{v.x, v.y, v.z}; };
  return to_text({{"schema", "etalon/view/1"},
                  {"eye", vector(camera.eye)},
                  {"target", vector(camera.target)},
                  {"up", vector(camera.up)},
                  {"tan_half_fov_y", camera.tan_half_fov_y},
                  {"near", camera.near},
                  {"far", camera.far},
                  {"width", width},
                  {"height", height}});
}

}  // namespace etalon::validation
