#include "core/io/json_ref.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/io/input_error.h"

namespace etalon::io {

void JsonRef::fail(const std::string& what) const { fail_file(*file_, fmt::format("{}: {}", path_, what)); }

JsonRef JsonRef::at(const char* key) const {
  if (!value_->is_object()) fail(fmt::format("expected an object, got {}", value_->type_name()));
  const auto found = value_->find(key);
  if (found == value_->end()) fail(fmt::format("expected a member '{}', got none", key));
  return {*found, is_root_ ? std::string(key) : path_ + "." + key, *file_, false};
}

JsonRef JsonRef::at(std::uint64_t index) const {
  if (index >= size()) fail(fmt::format("index expected below {}, got {}", size(), index));
  return {(*value_)[static_cast<std::size_t>(index)], fmt::format("{}[{}]", path_, index), *file_, false};
}

std::size_t JsonRef::size() const {
  if (!value_->is_array()) fail(fmt::format("expected an array, got {}", value_->type_name()));
  return value_->size();
}

std::uint64_t JsonRef::integer() const {
  if (value_->is_number_unsigned()) return value_->get<std::uint64_t>();
  // An integer may be written with a fraction of zero (glTF 2.0, 2.7.2).
  if (value_->is_number_float()) {
    const double number = value_->get<double>();
    if (number >= 0 && number <= 0x1p53 && number == std::floor(number)) return static_cast<std::uint64_t>(number);
  }
  fail(fmt::format("expected an integer from 0, got {}", printable(value_->is_number() ? value_->dump() : value_->type_name())));
}

double JsonRef::real() const {
  if (!value_->is_number()) fail(fmt::format("expected a number, got {}", value_->type_name()));
  return value_->get<double>();
}

std::string JsonRef::text() const {
  if (!value_->is_string()) fail(fmt::format("expected a string, got {}", value_->type_name()));
  return value_->get<std::string>();
}

bool JsonRef::true_at(const char* key) const { return has(key) && (*value_)[key].is_boolean() && (*value_)[key].get<bool>(); }

bool JsonRef::boolean() const {
  if (!value_->is_boolean()) fail(fmt::format("expected true or false, got {}", value_->type_name()));
  return value_->get<bool>();
}

void JsonRef::require_only(std::initializer_list<const char*> keys) const {
  if (!value_->is_object()) fail(fmt::format("expected an object, got {}", value_->type_name()));
  for (const auto& member : value_->items()) {
    const std::string& key = member.key();
    if (std::none_of(keys.begin(), keys.end(), [&](const char* known) { return key == known; }))
      fail(fmt::format("expected one of {}, got a member '{}'", fmt::join(keys, ", "), printable(key)));
  }
}

}  // namespace etalon::io
