// The style sheets and the script of the pages, embedded from page.css, study.css and page.js when etalon is built.
#pragma once

#include <string>

namespace etalon::validation {

extern const std::string kPageCss;
extern const std::string kPageJs;
extern const std::string kStudyCss;  ///< beyond kPageCss

}  // namespace etalon::validation
