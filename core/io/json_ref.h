// Checked access to a JSON document from outside: whoever walks it can only meet values that are there.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

namespace etalon::io {

/// A value of the document that knows its path; every accessor throws InputError "FILE: PATH: what, expected, got" instead of guessing.
class JsonRef {
 public:
  /// `path` names the document in messages; its members stand without it.
  JsonRef(const nlohmann::json& value, std::string path, const std::string& file) : JsonRef(value, std::move(path), file, true) {}

  [[nodiscard]] bool has(const char* key) const { return value_->is_object() && value_->contains(key); }
  [[nodiscard]] JsonRef at(const char* key) const;
  [[nodiscard]] JsonRef at(std::uint64_t index) const;
  [[nodiscard]] std::size_t size() const;  ///< of an array
  [[nodiscard]] std::uint64_t integer() const;
  [[nodiscard]] std::uint64_t integer_or(const char* key, std::uint64_t fallback) const { return has(key) ? at(key).integer() : fallback; }
  [[nodiscard]] double real() const;
  [[nodiscard]] std::string text() const;
  [[nodiscard]] std::string text_or(const char* key, const char* fallback) const { return has(key) ? at(key).text() : fallback; }
  [[nodiscard]] bool is_null() const { return value_->is_null(); }
  [[nodiscard]] bool is_text() const { return value_->is_string(); }
  [[nodiscard]] bool true_at(const char* key) const;
  [[nodiscard]] bool boolean() const;
  /// Refuses any member of this object that is not one of `keys`.
  void require_only(std::initializer_list<const char*> keys) const;
  [[nodiscard]] const std::string& path() const { return path_; }
  [[noreturn]] void fail(const std::string& what) const;

 private:
  JsonRef(const nlohmann::json& value, std::string path, const std::string& file, bool is_root)
      : value_(&value), path_(std::move(path)), file_(&file), is_root_(is_root) {}
  const nlohmann::json* value_;
  std::string path_;
  const std::string* file_;
  bool is_root_;
};

}  // namespace etalon::io
