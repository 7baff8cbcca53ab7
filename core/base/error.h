// The errors of etalon, in three kinds:
//   a bug of ours          ETALON_CHECK, always on, throws InternalError naming the condition and its operands;
//   bad outside data       a typed exception below, its text made for a person: "FILE:LINE: what, expected, got";
//   degenerate geometry    a documented result, never an error.
#pragma once

#include <stdexcept>
#include <string>

namespace etalon {

/// Base of everything etalon throws on purpose; `what()` is one line without a trailing newline.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file or a value from outside is not what it must be (exit code 4 of the command line).
class InputError : public Error {
 public:
  using Error::Error;
};

/// A file could not be written completely; nothing half-written is left behind (exit code 4).
class WriteError : public Error {
 public:
  using Error::Error;
};

/// Something optional is missing on this machine: OpenGL, a data file (exit code 1, tests report a skip).
class UnavailableError : public Error {
 public:
  using Error::Error;
};

/// A condition that only a defect of etalon itself can break.
class InternalError : public Error {
 public:
  using Error::Error;
};

[[noreturn]] void throw_check_failed(const char* file, int line, const char* condition, const std::string& detail);

}  // namespace etalon

/// Always-on check of an invariant; `detail` is any std::string expression with the operands.
#define ETALON_CHECK(condition, detail)                                       \
  do {                                                                        \
    if (!(condition)) [[unlikely]]                                            \
      ::etalon::throw_check_failed(__FILE__, __LINE__, #condition, (detail)); \
  } while (false)
