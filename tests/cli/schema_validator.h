// Validates a JSON document against the subset of JSON Schema that docs/schemas uses; refuses a schema that uses anything else.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace etalon::test {

/// What is wrong, one string each, as "/jobs/0/texels: expected integer"; empty where the document is valid.
/// Throws std::runtime_error for a keyword that it does not know.
[[nodiscard]] std::vector<std::string> schema_violations(const nlohmann::json& schema, const nlohmann::json& document);

}  // namespace etalon::test
