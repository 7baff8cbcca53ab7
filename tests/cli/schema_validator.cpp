#include "tests/cli/schema_validator.h"

#include <algorithm>
#include <regex>
#include <set>
#include <stdexcept>

namespace etalon::test {
namespace {

using Json = nlohmann::json;

const std::set<std::string> kKeywords{
    "$schema", "$defs",       "$ref", "title", "type",    "properties", "required", "additionalProperties",
    "items",   "prefixItems", "enum", "const", "minimum", "maximum",    "pattern"};

class Validator {
 public:
  explicit Validator(const Json& root) : root_(root) {}

  void check(const Json& schema, const Json& value, const std::string& at) {
    for (const auto& [keyword, unused] : schema.items()) {
      if (kKeywords.count(keyword) == 0) throw std::runtime_error("schema keyword not supported: " + keyword);
    }
    if (schema.contains("$ref")) return check(resolve(schema["$ref"]), value, at);
    if (schema.contains("type") && !matches_type(schema["type"], value))
      return report(at, "expected " + schema["type"].dump() + ", got " + value.dump().substr(0, 40));
    if (schema.contains("const") && value != schema["const"]) report(at, "expected " + schema["const"].dump());
    if (schema.contains("enum") && std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end())
      report(at, "expected one of " + schema["enum"].dump());
    if (schema.contains("minimum") && value.is_number() && value.get<double>() < schema["minimum"].get<double>())
      report(at, "below the minimum");
    if (schema.contains("maximum") && value.is_number() && value.get<double>() > schema["maximum"].get<double>())
      report(at, "above the maximum");
    if (schema.contains("pattern") && value.is_string() &&
        !std::regex_search(value.get<std::string>(), std::regex(schema["pattern"].get<std::string>())))
      report(at, "does not match the pattern");
    if (value.is_object()) check_object(schema, value, at);
    if (value.is_array()) check_array(schema, value, at);
  }

  std::vector<std::string> violations;

 private:
  void report(const std::string& at, const std::string& what) { violations.push_back((at.empty() ? "/" : at) + ": " + what); }

  const Json& resolve(const std::string& reference) const {
    if (reference.rfind("#/", 0) != 0) throw std::runtime_error("reference not supported: " + reference);
    return root_.at(Json::json_pointer(reference.substr(1)));
  }

  static bool matches_type(const Json& type, const Json& value) {
    if (type.is_array()) return std::any_of(type.begin(), type.end(), [&](const Json& one) { return matches_type(one, value); });
    const std::string name = type;
    if (name == "object") return value.is_object();
    if (name == "array") return value.is_array();
    if (name == "string") return value.is_string();
    if (name == "integer") return value.is_number_integer();
    if (name == "number") return value.is_number();
    if (name == "boolean") return value.is_boolean();
    if (name == "null") return value.is_null();
    throw std::runtime_error("type not supported: " + name);
  }

  void check_object(const Json& schema, const Json& value, const std::string& at) {
    for (const Json& name : schema.value("required", Json::array())) {
      if (!value.contains(name.get<std::string>())) report(at, "lacks " + name.get<std::string>());
    }
    const Json properties = schema.value("properties", Json::object());
    const Json additional = schema.value("additionalProperties", Json(true));
    for (const auto& [name, member] : value.items()) {
      const std::string place = at + "/" + name;
      if (properties.contains(name))
        check(properties[name], member, place);
      else if (additional.is_object())
        check(additional, member, place);
      else if (additional == false)
        report(place, "not in the schema");
    }
  }

  void check_array(const Json& schema, const Json& value, const std::string& at) {
    const Json prefix = schema.value("prefixItems", Json::array());
    if (!prefix.empty() && prefix.size() != value.size()) report(at, "expected " + std::to_string(prefix.size()) + " items");
    for (std::size_t i = 0; i < value.size(); ++i) {
      const std::string place = at + "/" + std::to_string(i);
      if (i < prefix.size())
        check(prefix[i], value[i], place);
      else if (schema.contains("items"))
        check(schema["items"], value[i], place);
    }
  }

  const Json& root_;
};

}  // namespace

std::vector<std::string> schema_violations(const Json& schema, const Json& document) {
  Validator validator(schema);
  validator.check(schema, document, "");
  return validator.violations;
}

}  // namespace etalon::test
