#include "tests/bench/child.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include <fmt/format.h>

#include "core/base/error.h"

namespace etalon::bench {
namespace {

template <class T>
void write_array(std::ofstream& file, const std::vector<T>& values) {
  const std::uint64_t count = values.size();
  file.write(reinterpret_cast<const char*>(&count), sizeof count);
  file.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
}

template <class T>
std::vector<T> read_array(std::ifstream& file) {
  std::uint64_t count = 0;
  file.read(reinterpret_cast<char*>(&count), sizeof count);
  std::vector<T> values(file ? count : 0);
  file.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(T)));
  return values;
}

}  // namespace

ScratchDirectory::ScratchDirectory() : path_(std::filesystem::temp_directory_path() / fmt::format("etalon-bench-{}", getpid())) {
  std::filesystem::create_directories(path_);
}

ScratchDirectory::~ScratchDirectory() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

void write_raw_mesh(const std::filesystem::path& path, const Mesh& mesh) {
  std::vector<std::array<std::uint32_t, 3>> faces;
  faces.reserve(mesh.face_count());
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    faces.push_back({mesh.vertex(FaceId(f), 0).index, mesh.vertex(FaceId(f), 1).index, mesh.vertex(FaceId(f), 2).index});
  std::ofstream file(path, std::ios::binary);
  write_array(file, mesh.positions);
  write_array(file, mesh.colors);
  write_array(file, faces);
  if (!file.flush()) throw WriteError(fmt::format("{}: cannot be written", path.string()));
}

Mesh read_raw_mesh(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  Mesh mesh;
  mesh.positions = read_array<Vec3f>(file);
  mesh.colors = read_array<Vec4f>(file);
  const auto faces = read_array<std::array<std::uint32_t, 3>>(file);
  if (!file) throw InputError(fmt::format("{}: expected a raw mesh, got its end", path.string()));
  mesh.wedges.reserve(mesh.vertex_count());
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) mesh.wedges.push_back({VertexId(v), {0, 0}});
  mesh.faces.reserve(faces.size());
  for (const auto& f : faces) mesh.faces.push_back({WedgeId(f[0]), WedgeId(f[1]), WedgeId(f[2])});
  return mesh;
}

ChildCost run_program(const std::vector<std::string>& command, const std::filesystem::path& error_log) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  int pipe_ends[2];
  if (pipe(pipe_ends) != 0) throw WriteError(fmt::format("pipe: {}", std::strerror(errno)));
  const pid_t child = fork();
  if (child < 0) throw WriteError(fmt::format("fork: {}", std::strerror(errno)));
  if (child == 0) {
    const int log = open(error_log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (log >= 0) dup2(log, STDERR_FILENO);
    dup2(pipe_ends[1], STDOUT_FILENO);
    close(pipe_ends[0]);
    close(pipe_ends[1]);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  close(pipe_ends[1]);
  ChildCost cost;
  char buffer[4096];
  for (ssize_t count; (count = read(pipe_ends[0], buffer, sizeof buffer)) > 0;) cost.output.append(buffer, static_cast<std::size_t>(count));
  close(pipe_ends[0]);
  int status = 0;
  rusage usage{};
  if (wait4(child, &status, 0, &usage) != child) return cost;
  cost.exit_code = WIFEXITED(status) ? (WEXITSTATUS(status) == 127 ? -1 : WEXITSTATUS(status)) : 128 + WTERMSIG(status);
  const auto seconds = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
  cost.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  return cost;
}

}  // namespace etalon::bench
