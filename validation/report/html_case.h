// The part of the page that shows one scene.
#pragma once

#include <string>

#include "validation/verify/verify_result.h"

namespace etalon::validation {

/// `<article>` of one scene; `id` is unique on the page, [a-z0-9-]. `gl_name`: the device's name for labels.
[[nodiscard]] std::string case_article(const CaseResult& item, const std::string& id);

/// A chip "■ tie" with the colour of the class.
[[nodiscard]] std::string class_chip(const std::string& texel_class);

/// Share of all texels for people: "99.9871 %", "< 0.0001 %", "0 %"; never rounds a part to all or to nothing.
[[nodiscard]] std::string share(std::uint64_t part, std::uint64_t all);

}  // namespace etalon::validation
