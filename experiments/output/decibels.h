#pragma once

#include <cmath>
#include <optional>
#include <string>

namespace gsp {

// A surface that is met exactly has no distance and an infinite PSNR. It is infinite in memory and "inf" in CSV;
// "exact" for people; null in JSON, with the reason beside it; in plots a size from which on the curve is exact, not a
// height.

inline constexpr const char* kExactReason = "infinite: the surface is met exactly";

/// Decibels for people: "61.3", or "exact".
std::string db_text(double db, int digits);

/// Puts decibels into a JSON object: a number; null, with the reason as NAME_reason, where they are infinite; null
/// alone where there are none.
template <class Json>
void put_db(Json& object, const std::string& name, const std::optional<double>& db) {
  object[name] = db && std::isfinite(*db) ? Json(*db) : Json();
  if (db && std::isinf(*db)) object[name + "_reason"] = kExactReason;
}

}  // namespace gsp
