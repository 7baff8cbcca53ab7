// The command line itself is wrong: exit code 64.
#pragma once

#include "core/base/error.h"

namespace etalon::cli {

class UsageError : public Error {
 public:
  using Error::Error;
};

}  // namespace etalon::cli
