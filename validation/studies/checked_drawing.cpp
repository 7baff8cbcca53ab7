#include "validation/studies/checked_drawing.h"

namespace etalon::validation {

CheckedDrawing::Group& CheckedDrawing::group(const std::string& name) {
  for (Group& known : groups_)
    if (known.name == name) return known;
  groups_.push_back({.name = name, .pictures = 0, .counts = {}});
  return groups_.back();
}

DrawnView CheckedDrawing::draw(const std::string& name, const std::function<StudyScene(const RasterState&)>& scene) {
  const StudyScene own = scene({});
  std::vector<Image> golden = exact_.render(own.list, own.frame);
  Group& into = group(name);
  ++into.pictures;
  if (device_ != nullptr) {
    const RasterState state = device_->supported_state({});
    const bool same = state == RasterState{};
    const StudyScene theirs = same ? StudyScene{} : scene(state);
    const StudyScene& both = same ? own : theirs;
    const std::vector<Image> candidate = device_->render(both.list, both.frame);
    const std::vector<Image> other = same ? std::vector<Image>{} : exact_.render(both.list, both.frame);
    into.counts +=
        diff_images(both.list, both.frame, model_, same ? golden : other, candidate, {.worst_count = 1, .keep_class_image = false}).counts;
  }
  return {std::move(golden[0]), std::move(golden[1])};
}

}  // namespace etalon::validation
