#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "experiments/curve/curve.h"

namespace gsp {

/// Writes a JSON file as a whole. Bytes that are not UTF-8, as names of files may hold them, are replaced.
/// Throws Error(CannotWrite).
void write_json(const std::string& path, const nlohmann::ordered_json& json);

/// Reads one. Throws Error(CannotOpen), and Error(Malformed) with the path and line where it is no JSON.
nlohmann::ordered_json read_json(const std::string& path);

/// What was measured of a point, by the names of `measured_fields`. A surface that is met exactly has an infinite PSNR,
/// which JSON cannot hold: it is null, with the reason beside it (output/decibels.h).
nlohmann::ordered_json measured_json(const CurvePoint& point);

/// The inverse. Throws nlohmann::json::exception where a field is missing or of another type.
CurvePoint measured_point(const nlohmann::ordered_json& json);

}  // namespace gsp
