#include "core/base/error.h"

#include <fmt/format.h>

namespace etalon {

void throw_check_failed(const char* file, int line, const char* condition, const std::string& detail) {
  throw InternalError(fmt::format("internal check failed at {}:{}: {} ({})", file, line, condition, detail));
}

}  // namespace etalon
