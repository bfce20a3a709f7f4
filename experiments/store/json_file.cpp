#include "experiments/store/json_file.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "experiments/curve/point_fields.h"
#include "mesh/atomic_file.h"
#include "mesh/error.h"
#include "mesh/read_file.h"

namespace gsp {

namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson json_of(double value) { return std::isfinite(value) ? OrderedJson(value) : OrderedJson(); }

template <class Value>
OrderedJson json_of(const Value& value) {
  return value;
}

template <class Value>
void read_value(const OrderedJson& json, Value& value) {
  value = json.get<Value>();
}

void read_value(const OrderedJson& json, double& value) {
  value = json.is_null() ? std::numeric_limits<double>::infinity() : json.get<double>();
}

}  // namespace

void write_json(const std::string& path, const OrderedJson& json) {
  AtomicFile file(path);
  file.stream() << json.dump(1, ' ', false, OrderedJson::error_handler_t::replace) << '\n';
  file.commit();
}

OrderedJson read_json(const std::string& path) {
  try {
    return OrderedJson::parse(read_file(path));
  } catch (const OrderedJson::exception& error) {
    throw Error(Cause::Malformed, path + ": " + error.what());
  }
}

OrderedJson measured_json(const CurvePoint& point) {
  OrderedJson json = OrderedJson::object();
  for (const PointField& field : measured_fields())
    std::visit([&](auto member) { json[field.name] = json_of(point.*member); }, field.member);
  return json;
}

CurvePoint measured_point(const OrderedJson& json) {
  CurvePoint point;
  for (const PointField& field : measured_fields())
    std::visit([&](auto member) { read_value(json.at(field.name), point.*member); }, field.member);
  return point;
}

}  // namespace gsp
