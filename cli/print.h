#pragma once

#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cli/command.h"
#include "mesh/error.h"
#include "mesh/profile.h"

namespace gsp::cli {

/// A result as ordered names and values. Numbers that are not finite become null.
using Json = nlohmann::ordered_json;

/// Prints a result to the context's output: with --json as one JSON object that names the program's version, otherwise
/// one line a value, names with their underscores as spaces.
void print_report(const Context& context, const Json& report);

/// The same result with what each step took: as "profile" of the JSON object (experiments/output/profile_json.h), as
/// text in a table behind the rest.
void print_report(const Context& context, Json report, const std::vector<ProfileStep>& steps);

/// The same result as text.
void print_text(std::ostream& out, const Json& report);

/// {"cause", "message", "element", "index"} of an error.
Json error_report(const Error& error);

}  // namespace gsp::cli
