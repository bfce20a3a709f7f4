#include "experiments/store/json_file.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "experiments/curve/point_fields.h"
#include "experiments/output/decibels.h"
#include "mesh/atomic_file.h"
#include "mesh/error.h"
#include "mesh/read_file.h"

namespace gsp {

namespace {

using OrderedJson = nlohmann::ordered_json;

template <class Value>
void read_value(const OrderedJson& json, Value& value) {
  value = json.get<Value>();
}

void read_value(const OrderedJson& json, double& value) {
  value = json.is_null() ? std::numeric_limits<double>::infinity() : json.get<double>();
}

}  // namespace

void write_json(const std::string& path, const OrderedJson& json) {
  write_file(path, json.dump(1, ' ', false, OrderedJson::error_handler_t::replace) + '\n');
}

OrderedJson read_json(const std::string& path) {
  const std::string text = read_file(path);
  try {
    return OrderedJson::parse(text);
  } catch (const OrderedJson::parse_error& error) {
    const std::size_t read = std::min(error.byte, text.size());
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(read), '\n');
    throw Error(Cause::Malformed, path + " is no JSON", Element::Line, line);
  }
}

OrderedJson measured_json(const CurvePoint& point) {
  OrderedJson json = OrderedJson::object();
  for (const PointField& field : measured_fields())
    if (const auto* member = std::get_if<double CurvePoint::*>(&field.member))
      put_db(json, field.name, point.*(*member));
    else
      std::visit([&](auto member) { json[field.name] = point.*member; }, field.member);
  return json;
}

CurvePoint measured_point(const OrderedJson& json) {
  CurvePoint point;
  for (const PointField& field : measured_fields())
    std::visit([&](auto member) { read_value(json.at(field.name), point.*member); }, field.member);
  return point;
}

}  // namespace gsp
