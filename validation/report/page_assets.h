// The style sheet and the script of the page, embedded from page.css and page.js when etalon is built.
#pragma once

#include <string>

namespace etalon::validation {

extern const std::string kPageCss;
extern const std::string kPageJs;

}  // namespace etalon::validation
