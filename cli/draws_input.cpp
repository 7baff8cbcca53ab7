#include "cli/draws_input.h"

#include <filesystem>

#include "cli/model_input.h"

namespace etalon::cli {

bool is_draws_name(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return extension == ".draws";
}

io::DrawsFile load_draws(const std::string& path, CallFiles& files, std::vector<validation::VerifyInput>& inputs) {
  io::DrawsFile draws = io::read_draws(path);
  inputs.push_back(file_input(path, "draws"));
  for (const std::filesystem::path& image : draws.image_paths) {
    files.add_input(image.string(), "a texture of the draws");
    inputs.push_back(file_input(image.string(), "texture"));
  }
  return draws;
}

}  // namespace etalon::cli
