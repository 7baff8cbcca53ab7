// The manual page and the completion of bash, made of the same tables that the command line is parsed by: what is in neither is in no verb.
#pragma once

#include <string>

#include <CLI/App.hpp>

namespace etalon::cli {

/// roff with the macros of man(7), UTF-8: the verbs with their options, examples, exit codes. No date: the same bytes for the same version.
[[nodiscard]] std::string man_page(const CLI::App& root, const std::string& version);

/// A script that bash sources: verbs, options, and the words that an option is one of; file names elsewhere.
[[nodiscard]] std::string bash_completion(const CLI::App& root);

}  // namespace etalon::cli
