#include "cli/horbelt_subjects.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "cli/model_input.h"
#include "cli/study_subjects.h"
#include "cli/terrain_input.h"
#include "cli/terrain_view_option.h"
#include "cli/usage_error.h"
#include "core/procedural/alps.h"

namespace etalon::cli {
namespace {

using validation::HorbeltSubject;

constexpr const char* kDem = "davosdorf/davosdorf.tif";
constexpr const char* kImage = "davosdorf/davosdorf_color.tif";

class Loader {
 public:
  Loader(const HorbeltSubjectOptions& options, Console& console, CallFiles& files) : options_(options), console_(console), files_(files) {}

  [[nodiscard]] bool has_davosdorf() const {
    const std::filesystem::path folder = data_folder(options_.data);
    return !folder.empty() && std::filesystem::exists(folder / kDem) && std::filesystem::exists(folder / kImage);
  }

  /// The window and sizes of the study: 257² heights and 512² texels of columns 32 to 526.
  [[nodiscard]] HorbeltSubject davosdorf() {
    const std::filesystem::path folder = data_folder(options_.data);
    if (!has_davosdorf())
      throw InputError(
          fmt::format("davosdorf: expected {} and {} in the folder of real inputs (ETALON_DATA or --data), got none", kDem, kImage));
    return from_files("davosdorf", (folder / kDem).string(), (folder / kImage).string(),
                      {.grid = 257, .spacing_m = 10, .texture_size = 512});
  }

  [[nodiscard]] HorbeltSubject from_files(const std::string& name, const std::string& dem, const std::string& image,
                                          const TerrainOptions& options) {
    files_.add_input(dem, "DEM"), files_.add_input(image, "IMAGE");
    TerrainInput input = load_terrain(dem, image, options);
    for (const std::string& note : input.notes) console_.line(fmt::format("note: {}: {}", name, note));
    for (const std::string& warning : input.warnings) print_warning(dem + ": " + warning);
    HorbeltSubject subject = made(name, std::move(input.field), std::move(input.image));
    subject.inputs = {file_input(dem, "DEM"), file_input(image, "image")};
    subject.joint_command = fmt::format("etalon joint {} {}", subject.inputs[0].name, subject.inputs[1].name);
    subject.joint_command += terrain_arguments(options);
    subject.notes = std::move(input.notes), subject.warnings = std::move(input.warnings);
    return subject;
  }

  [[nodiscard]] HorbeltSubject alps() {
    procedural::AlpsOptions how;
    if (options_.quick) how.size = 65, how.texture_size = 128;
    how.progress = [&](int done, int total) { console_.progress("alps", done, total); };
    procedural::Alps alps = procedural::make_alps(how);
    terrain::DemOptions dem;
    dem.dem_spacing = alps.spacing;
    HorbeltSubject subject = made("alps", terrain::make_height_field(alps.dem, dem).field, std::move(alps.texture));
    subject.joint_command =
        fmt::format("etalon make terrain --size {} --texture-size {} -o alps.tif && etalon joint alps.tif alps_color.png --spacing {}",
                    how.size, how.texture_size, alps.spacing);
    subject.inputs = {
        {.name = "alps (procedural, heights)", .sha256 = alps.dem.sha256(), .path = "", .role = "DEM", .attribution = ""},
        {.name = "alps (procedural, image)", .sha256 = subject.image.sha256(), .path = "", .role = "image", .attribution = ""}};
    return subject;
  }

 private:
  static HorbeltSubject made(const std::string& name, terrain::HeightField field, Image image) {
    HorbeltSubject subject;
    subject.name = name;
    subject.title = fmt::format("{}, {}² heights, {}² texels", name, field.side(), image.width());
    subject.field = std::move(field), subject.image = std::move(image);
    return subject;
  }

  const HorbeltSubjectOptions& options_;
  Console& console_;
  CallFiles& files_;
};

std::string stem_of(const std::string& path) { return plain_name(std::filesystem::path(path).stem().string()); }

void choose_views(HorbeltSubject& subject, const HorbeltSubjectOptions& options) {
  for (const std::string& text : options.views) {
    validation::NamedTerrainView view = chosen_terrain_view(text, options.size, options.frame, subject.field);
    if (const std::string prefix = subject.name + "-"; view.name.size() > prefix.size() && view.name.starts_with(prefix))
      view.name.erase(0, prefix.size());
    for (const validation::NamedTerrainView& other : subject.views)
      if (other.name == view.name)
        throw UsageError(fmt::format("--view: two views of the name {}: {} and {}", view.name, other.title, view.title));
    subject.views.push_back(std::move(view));
  }
}

void require_no_terrain_options(const HorbeltSubjectOptions& options) {
  if (const std::string given = terrain_arguments(options.terrain); !given.empty())
    throw UsageError(fmt::format("study horbelt:{}: belongs to a DEM and an IMAGE of one's own", given));
}

std::vector<HorbeltSubject> loaded(const HorbeltSubjectOptions& options, Loader& loader, Console& console) {
  std::vector<HorbeltSubject> subjects;
  if (options.models.empty()) {
    if (!options.quick && loader.has_davosdorf())
      subjects.push_back(loader.davosdorf());
    else if (!options.quick)
      console.line(fmt::format("note: {} is not there: davosdorf is left out (ETALON_DATA or --data)", kDem));
    subjects.push_back(loader.alps());
    require_no_terrain_options(options);
    return subjects;
  }
  bool has_own = false;
  for (std::size_t n = 0; n < options.models.size(); ++n) {
    const std::string& model = options.models[n];
    if (model == "davosdorf") {
      subjects.push_back(loader.davosdorf());
    } else if (model == "alps") {
      subjects.push_back(loader.alps());
    } else {
      if (n + 1 == options.models.size()) throw UsageError(fmt::format("study horbelt: {}: expected an IMAGE after the DEM", model));
      subjects.push_back(loader.from_files(stem_of(model), model, options.models[n + 1], options.terrain));
      has_own = true;
      ++n;
    }
    const auto is_same = [&](const HorbeltSubject& other) { return other.name == subjects.back().name; };
    if (std::count_if(subjects.begin(), subjects.end(), is_same) > 1)
      throw UsageError(fmt::format("study horbelt: two terrains of the name {}", subjects.back().name));
  }
  if (!has_own) require_no_terrain_options(options);
  return subjects;
}

}  // namespace

std::vector<HorbeltSubject> load_horbelt_subjects(const HorbeltSubjectOptions& options, Console& console, CallFiles& files) {
  for (const std::string& view : options.views)
    if (std::filesystem::exists(view)) files.add_input(view, "--view");
  Loader loader(options, console, files);
  std::vector<HorbeltSubject> subjects = loaded(options, loader, console);
  for (HorbeltSubject& subject : subjects) choose_views(subject, options);
  return subjects;
}

}  // namespace etalon::cli
